// What a provider knows of the road.
#include "actors/planning/planning_site.hpp"

#include "messages/v2x/sighting.hpp"
#include "world/protocol.hpp"

#include <utility>

namespace sofof {

namespace {

/// Nobody has more vehicles round him; more are made up.
constexpr std::size_t most_stations = 10'000;

} // namespace

perceived_object body_of(const cam& c) {
  const vehicle_params ours;
  const auto axle_share = ours.front_m / (ours.front_m + ours.rear_m);
  const auto centre_ahead_m = (axle_share - 0.5) * c.length_m;
  return {c.position + centre_ahead_m * unit_vector(c.heading_rad),
          c.heading_rad,
          c.speed_mps,
          c.accel_mps2,
          c.length_m,
          c.width_m};
}

planning_site::planning_site(std::function<time_point()> clock)
    : clock_{std::move(clock)} {}

void planning_site::hear(const cam& c) {
  const auto now = clock_();
  if (protocol::is_of_future(c.at, now))
    return;
  const std::lock_guard lock{mutex_};
  model_.hear(c.at, c.station, body_of(c));
  forget_silent(now);
  if (told_.size() >= most_stations && !told_.contains(c.station))
    return;
  auto& newest = told_[c.station];
  if (newest.at <= c.at)
    newest = c;
}

void planning_site::see(time_point at, std::span<const perceived_object> seen) {
  if (protocol::is_of_future(at, clock_()))
    return;
  const std::lock_guard lock{mutex_};
  model_.update(at, seen);
}

std::optional<cam> planning_site::told_by(station_id who) const {
  const std::lock_guard lock{mutex_};
  const auto x = told_.find(who);
  if (x == told_.end() || clock_() - x->second.at > protocol::cam_timeout)
    return std::nullopt;
  return x->second;
}

void planning_site::tracks(std::vector<track>& out) const {
  const std::lock_guard lock{mutex_};
  out.assign(model_.tracks().begin(), model_.tracks().end());
}

void planning_site::forget_silent(time_point now) {
  if (now - tidied_ < protocol::cam_timeout)
    return;
  tidied_ = now;
  std::erase_if(told_, [now](const auto& x) {
    return now - x.second.at > protocol::cam_timeout;
  });
}

} // namespace sofof
