// A line is kept until its end comes.
#include "apps/json_log.hpp"

#include "base/text/json.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>

namespace sofof::apps {

namespace {

std::string time_of_day() {
  using std::chrono::system_clock;
  const auto now = system_clock::now();
  const auto ms =
      std::chrono::floor<std::chrono::milliseconds>(now.time_since_epoch())
          .count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(system_clock::to_time_t(now)), ms % 1000);
}

} // namespace

json_log::json_log(std::ostream& to, std::string_view role)
    : to_{to}, role_{role} {}

json_log::int_type json_log::overflow(int_type c) {
  if (!traits_type::eq_int_type(c, traits_type::eof()))
    add(traits_type::to_char_type(c));
  return traits_type::not_eof(c);
}

std::streamsize json_log::xsputn(const char* text, std::streamsize size) {
  for (const auto c : std::string_view{text, static_cast<std::size_t>(size)})
    add(c);
  return size;
}

int json_log::sync() {
  return to_.flush() ? 0 : -1;
}

void json_log::add(char c) {
  if (c != '\n') {
    line_ += c;
    return;
  }
  if (line_.empty())
    return;
  std::string text;
  {
    json_object object{text, json_object::layout::one_line};
    object.member("time", time_of_day());
    object.member("role", role_);
    object.member("message", line_);
  }
  to_ << text << '\n';
  line_.clear();
}

} // namespace sofof::apps
