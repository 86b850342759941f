// How single values look in a TOML file.
#include "base/options/toml_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace sofof {

std::string quoted_toml(std::string_view text) {
  std::string result{'"'};
  for (const auto c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (code < 0x20 || code == 0x7f)
      fmt::format_to(std::back_inserter(result), "\\u{:04X}", code);
    else
      result += c;
  }
  return result += '"';
}

std::string number_text(double value) {
  auto text = fmt::format("{}", value);
  const auto whole = text.find_first_of(".e") == text.npos;
  return std::isfinite(value) && whole ? text + ".0" : text;
}

} // namespace sofof
