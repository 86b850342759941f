// Numbers and types of a message, as CAF's binary serializer writes them.
#include "actors/remote/frame_reader.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::actors {

std::optional<std::uint16_t> frame_reader::number(std::size_t octets) {
  assert(octets == 1 || octets == 2);
  if (left_.size() < octets)
    return std::nullopt;
  std::uint16_t value = 0;
  for (const auto octet : left_.first(octets))
    value = static_cast<std::uint16_t>(value << 8
                                       | std::to_integer<unsigned>(octet));
  left_ = left_.subspan(octets);
  return value;
}

std::optional<std::size_t> frame_reader::short_size() {
  const auto low = number(1);
  if (!low || *low < 0x80)
    return low;
  const auto high = number(1);
  if (!high || *high == 0 || *high >= 0x80)
    return std::nullopt;
  return static_cast<std::size_t>(*high) << 7 | (*low & 0x7f);
}

std::optional<element_types> element_types::read(frame_reader& in) {
  element_types all;
  const auto stages = in.short_size();
  const auto count = in.short_size();
  if (stages != 0 || !count || *count > all.types_.size())
    return std::nullopt;
  all.count_ = *count;
  for (std::size_t i = 0; i < *count; ++i) {
    const auto type = in.number(2);
    if (!type)
      return std::nullopt;
    all.types_[i] = *type;
  }
  return all;
}

bool element_types::are(std::span<const std::uint16_t> others) const {
  return std::ranges::equal(std::span{types_}.first(count_), others);
}

} // namespace sofof::actors
