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
