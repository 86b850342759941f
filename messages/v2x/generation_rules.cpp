// When something is worth another message.
#include "messages/v2x/generation_rules.hpp"

#include <cmath>

namespace sofof::messages {

bool is_news(const told_motion& told, const told_motion& now) {
  using namespace generation;
  return distance_m(told.position, now.position) > moved_m
         || std::abs(now.speed_mps - told.speed_mps) > faster_mps
         || std::abs(wrap_angle(now.heading_rad - told.heading_rad))
                > turned_rad;
}

} // namespace sofof::messages
