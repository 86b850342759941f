// When an offer was made, and how its provider moved then: 0, 8, 24 or 32
// octets.
#include "messages/protocol/service.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace sofof::messages {

namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they lie in memory");

using packed_time = duration::rep;
using packed_motion = std::array<double, 3>; // velocity, reach

template <class T>
void append_octets(std::string& text, const T& x) {
  std::array<char, sizeof(T)> octets{};
  std::memcpy(octets.data(), &x, sizeof(T));
  text.append(octets.data(), octets.size());
}

/// @returns whether numbers of a stranger can be reckoned with.
bool is_motion(const packed_motion& x) {
  for (const auto number : x)
    if (!std::isfinite(number))
      return false;
  return true;
}

} // namespace

std::string offer_stamp::packed() const {
  std::string text;
  if (created)
    append_octets(text, created->time_since_epoch().count());
  if (moves)
    append_octets(text, packed_motion{moves->velocity_mps.x_m,
                                      moves->velocity_mps.y_m, moves->reach_m});
  return text;
}

bool offer_stamp::unpack(const std::string& text) {
  constexpr auto motion_size = sizeof(packed_motion);
  const auto has_motion = text.size() >= motion_size;
  const auto time_size = text.size() - (has_motion ? motion_size : 0);
  if (time_size != 0 && time_size != sizeof(packed_time))
    return false;
  std::optional<time_point> at;
  std::optional<provider_motion> how;
  if (time_size > 0) {
    packed_time count = 0;
    std::memcpy(&count, text.data(), sizeof count);
    at.emplace(duration{count});
    if (!is_plausible(*at))
      return false;
  }
  if (has_motion) {
    packed_motion numbers{};
    std::memcpy(&numbers, text.data() + time_size, motion_size);
    if (!is_motion(numbers))
      return false;
    how = {{numbers[0], numbers[1]}, numbers[2]};
  }
  created = at;
  moves = how;
  return true;
}

} // namespace sofof::messages
