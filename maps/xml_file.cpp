// An XML file in memory, with the place of everything in it.
#include "maps/xml_file.hpp"

#include "base/input_error.hpp"
#include "base/text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace sofof::maps {

namespace {

/// @returns how many bytes the sequence has that begins with this one; 0 if
/// none does.
std::size_t sequence_length(unsigned char first) {
  if (first < 0x80)
    return 1;
  if (first >= 0xc2 && first < 0xe0)
    return 2;
  if (first >= 0xe0 && first < 0xf0)
    return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

/// RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return static_cast<unsigned char>(text[i + k]);
    };
    const auto length = sequence_length(byte(0));
    if (length == 0 || i + length > text.size())
      return false;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(k) & 0xc0) != 0x80)
        return false;
    if ((byte(0) == 0xe0 && byte(1) < 0xa0)
        || (byte(0) == 0xed && byte(1) >= 0xa0)
        || (byte(0) == 0xf0 && byte(1) < 0x90)
        || (byte(0) == 0xf4 && byte(1) >= 0x90))
      return false;
    i += length;
  }
  return true;
}

} // namespace

xml_file::xml_file(std::string_view text, std::string file)
    : source_{text}, file_{std::move(file)} {
  const auto result = document_.load_buffer(
      text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result)
    refuse(result.offset,
           fmt::format("this is no XML: {}.", result.description()));
  if (!root())
    refuse(std::ptrdiff_t{0}, "this is no XML: there is no element.");
}

void xml_file::refuse(std::ptrdiff_t offset, std::string_view why) const {
  const auto end = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      offset, 0, static_cast<std::ptrdiff_t>(source_.size())));
  const auto before = source_.substr(0, end);
  const auto line = std::ranges::count(before, '\n') + 1;
  const auto break_at = before.rfind('\n');
  const auto column = break_at == before.npos ? end + 1 : end - break_at;
  throw input_error{fmt::format("{}:{}:{}: {}", file_, line, column,
                                printable(std::string{why}))};
}

void xml_file::refuse(pugi::xml_node at, std::string_view why) const {
  refuse(at.offset_debug(), why);
}

std::string_view xml_file::text(pugi::xml_node at,
                                const char* attribute) const {
  const auto found = at.attribute(attribute);
  if (!found || !*found.value())
    refuse(at, fmt::format("<{}> needs the attribute \"{}\".", at.name(),
                           attribute));
  if (!is_utf8(found.value()))
    refuse(at, fmt::format("\"{}\" of <{}> is no UTF-8; save the file with "
                           "this encoding.",
                           attribute, at.name()));
  return found.value();
}

double xml_file::to_number(std::string_view text, pugi::xml_node at,
                           double least, double most) const {
  auto x = 0.0;
  const auto* const end = text.data() + text.size();
  const auto [rest, problem] = std::from_chars(text.data(), end, x);
  if (problem != std::errc{} || rest != end || !std::isfinite(x))
    refuse(at, fmt::format("\"{}\" of <{}> is no number.", text, at.name()));
  if (x < least || x > most)
    refuse(at, fmt::format("{} of <{}> must be from {} to {}.", text, at.name(),
                           least, most));
  return x;
}

double xml_file::number(pugi::xml_node at, const char* attribute, double least,
                        double most) const {
  return to_number(text(at, attribute), at, least, most);
}

std::optional<double> xml_file::optional_number(pugi::xml_node at,
                                                const char* attribute,
                                                double least,
                                                double most) const {
  if (!at.attribute(attribute))
    return std::nullopt;
  return number(at, attribute, least, most);
}

} // namespace sofof::maps
