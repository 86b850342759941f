// Sentences about faults.
#include "messages/etsi/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace sofof::messages::etsi {

namespace {

/// Of the ids from 1 on.
constexpr auto names = std::to_array<std::string_view>(
    {"DENM", "CAM",  "POIM", "SPATEM", "MAPEM", "IVIM",   "",
     "",     "SREM", "SSEM", "EVCSN",  "SAEM",  "RTCMEM", "CPM",
     "IMZM", "VAM",  "",     "",       "",      "MCM"});

} // namespace

std::string text_of(message_key key) {
  const std::size_t id = key[1];
  const auto is_known = id >= 1 && id <= names.size() && !names[id - 1].empty();
  return fmt::format("{} of protocol version {}",
                     is_known ? std::string{names[id - 1]}
                              : fmt::format("message {}", id),
                     key[0]);
}

std::string with_article(message_key key) {
  // Names that one spells out, and that begin with a vowel's sound then.
  constexpr auto as_an = std::to_array<std::string_view>(
      {"IVIM", "SREM", "SSEM", "EVCSN", "IMZM", "RTCMEM", "MCM"});
  const auto text = text_of(key);
  const auto name = std::string_view{text}.substr(0, text.find(' '));
  const auto is_an = std::ranges::find(as_an, name) != as_an.end();
  return (is_an ? "an " : "a ") + text;
}

std::string explain(message_key found, message_key known) {
  return fmt::format("this is {}, and not {}", with_article(found),
                     with_article(known));
}

std::string explain(const finding& found) {
  const auto& [path, what, value, low, high] = found;
  switch (what) {
    case fault::none:
      break;
    case fault::ends_early:
      return fmt::format("{} needs {} bit{}, more than are left", path, value,
                         value == 1 ? "" : "s");
    case fault::no_room:
      return "the buffer is too small";
    case fault::out_of_range:
      return fmt::format("{} = {} is {} {}", path, value,
                         value < low ? "below" : "beyond",
                         value < low ? low : high);
    case fault::unknown_choice:
      return fmt::format("{} is alternative {}, and only {} to {} are known",
                         path, value, low, high);
    case fault::bad_count:
      return fmt::format("{} has {} entries, and only {} to {} are allowed",
                         path, value, low, high);
    case fault::too_long:
      return fmt::format("{} has a length beyond {}", path, high);
    case fault::leftover:
      return value < 8 ? "the bits that fill the last octet are not all zero"
                       : "more follows than the message is long";
  }
  return {};
}

} // namespace sofof::messages::etsi
