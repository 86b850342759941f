// JSON on one line, with numbers that read back as the same bits.
#pragma once

#include "base/text/json.hpp"
#include "base/time.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

namespace sofof::programs {

/// Appends values one after the other, with commas where they belong. What is
/// opened is closed by its owner.
class json_writer {
public:
  explicit json_writer(std::string& out) : out_{out} {}

  json_writer& open(char bracket) {
    assert(bracket == '{' || bracket == '[');
    separate();
    out_ += bracket;
    is_first_ = true;
    return *this;
  }
  json_writer& close(char bracket) {
    assert(bracket == '}' || bracket == ']');
    out_ += bracket;
    is_first_ = false;
    return *this;
  }
  /// Of the member of an object, whose value follows.
  json_writer& key(std::string_view name) {
    separate();
    append_quoted(out_, name);
    out_ += ':';
    is_first_ = true;
    return *this;
  }
  json_writer& text(std::string_view text) {
    separate();
    append_quoted(out_, text);
    return *this;
  }
  json_writer& number(std::floating_point auto x) {
    return std::isfinite(x) ? digits(x) : null();
  }
  json_writer& number(std::unsigned_integral auto x) { return digits(x); }
  /// In seconds, exactly: no more decimals than it needs.
  json_writer& seconds(duration time) {
    auto text = std::string{};
    append(text, sofof::seconds(time));
    text.resize(text.find_last_not_of('0') + 1); // of nine decimals
    if (text.back() == '.')
      text.pop_back();
    separate();
    out_ += text;
    return *this;
  }
  json_writer& flag(bool x) {
    separate();
    out_ += x ? "true" : "false";
    return *this;
  }
  json_writer& null() {
    separate();
    out_ += "null";
    return *this;
  }

private:
  void separate() {
    if (!is_first_)
      out_ += ',';
    is_first_ = false;
  }
  json_writer& digits(auto x) {
    std::array<char, 32> buffer; // the longest double has 24
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
    separate();
    out_.append(buffer.data(), end);
    return *this;
  }

  std::string& out_;
  bool is_first_ = true;
};

} // namespace sofof::programs
