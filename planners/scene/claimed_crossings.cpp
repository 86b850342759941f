// Where drives that others have claimed close the own way, and when.
#include "planners/scene/claimed_crossings.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::planners {
namespace {

constexpr double step_m = 1;
/// A claim is kept so exactly.
constexpr double claim_exact_s = 0.3;

/// The claims of a station have one number, which is no track's.
std::uint32_t number_of(station_id who) {
  return 0x80000000U | who.value();
}

} // namespace

void list_claimed(const world::route& way, double width_m, time_point now,
                  std::span<const way_stretch> stretches,
                  std::span<const told_drive> told,
                  std::vector<crossing_user>& out) {
  assert(width_m > 0);
  constexpr auto never = std::numeric_limits<double>::infinity();
  for (const auto& [who, drive, is_claimed, front] : told) {
    if (!is_claimed || drive.empty() || drive.to() < now)
      continue;
    assert(drive.step > duration{});
    for (const auto& stretch : stretches) {
      crossing_user user{never, -never, never,         -never,
                         true,  never,  number_of(who)};
      for (auto s = stretch.from_m; s <= stretch.to_m; s += step_m) {
        const auto here = way.path().at(s);
        const oriented_box own{here.at, here.heading_rad, step_m, width_m};
        for (std::size_t k = 0; k < drive.bodies.size(); ++k) {
          const auto& body = drive.bodies[k];
          const auto reach_m = (body.length_m + body.width_m + width_m) / 2 + 1;
          const auto apart = body.centre - here.at;
          if (dot(apart, apart) > reach_m * reach_m || !overlap(own, body))
            continue;
          const auto t_s = to_seconds(
              drive.from + static_cast<duration::rep>(k) * drive.step - now);
          user.from_m = std::min(user.from_m, s - step_m / 2);
          user.to_m = std::max(user.to_m, s + step_m / 2);
          user.enter_s = std::min(user.enter_s, t_s - claim_exact_s);
          user.leave_s = std::max(user.leave_s, t_s + claim_exact_s);
        }
      }
      if (user.leave_s > 0 && user.from_m < user.to_m)
        out.push_back(user);
    }
  }
}

} // namespace sofof::planners
