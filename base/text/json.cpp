// Members, one after the other.
#include "base/text/json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace sofof {

void append_quoted(std::string& out, std::string_view text) {
  const auto plain = std::ranges::all_of(text, [](char c) {
    return c >= ' ' && c <= '~' && c != '"' && c != '\\';
  });
  if (plain) {
    out += '"';
    out += text;
    out += '"';
  } else {
    using json = nlohmann::json;
    out += json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  }
}

json_object::~json_object() {
  if (!empty_)
    new_line(depth_ - 1);
  out_ += '}';
}

void json_object::member(std::string_view name, std::string_view text) {
  start(name);
  append_quoted(out_, text);
}

void json_object::member(std::string_view name, decimal x) {
  start(name);
  if (x.digits)
    append(out_, x);
  else
    out_ += "null";
}

void json_object::member(std::string_view name, bool x) {
  start(name);
  out_ += x ? "true" : "false";
}

json_object json_object::object(std::string_view name) {
  start(name);
  return {out_, how_, depth_ + 1};
}

void json_object::start(std::string_view name) {
  if (!empty_)
    out_ += ',';
  empty_ = false;
  new_line(depth_);
  append_quoted(out_, name);
  out_ += how_ == layout::lines ? ": " : ":";
}

void json_object::new_line(int depth) {
  if (how_ == layout::one_line)
    return;
  out_ += '\n';
  out_.append(2 * static_cast<std::size_t>(depth), ' ');
}

} // namespace sofof
