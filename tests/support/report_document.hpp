// What a report's page carries, as the page itself reads it.
#pragma once

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <zlib.h>

namespace sofof::experiments::report {

using nlohmann::json;

inline std::string bytes_of(std::string_view base64) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "abcdefghijklmnopqrstuvwxyz"
                                       "0123456789+/";
  std::string bytes;
  std::uint32_t pending = 0;
  int bits = 0;
  for (const auto c : base64) {
    if (c == '=')
      break;
    pending = pending << 6 | static_cast<std::uint32_t>(letters.find(c));
    bits += 6;
    if (bits >= 8)
      bytes += static_cast<char>(pending >> (bits -= 8));
  }
  return bytes;
}

/// @returns what was compressed.
inline std::string inflated(std::string_view base64) {
  const auto bytes = bytes_of(base64);
  std::string text(1 << 22, '\0');
  auto size = static_cast<uLongf>(text.size());
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                     reinterpret_cast<const Bytef*>(bytes.data()), bytes.size())
          == Z_OK);
  text.resize(size);
  return text;
}

/// @returns the document of a page.
inline json document_in(const std::string& page) {
  constexpr std::string_view begin = "type=\"text/plain\">";
  const auto from = page.find(begin) + begin.size();
  return json::parse(
      inflated(page.substr(from, page.find("</script", from) - from)));
}

} // namespace sofof::experiments::report
