// What a provider knows of the road: all CAMs, all that its sensors and the
// vehicles it plans for see, put together.
#pragma once

#include "actors/planning/plan_in_use.hpp"
#include "actors/service_kind.hpp"
#include "messages/v2x/generation_rules.hpp"
#include "planners/environment_model.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sofof {

/// @returns the body of a vehicle with these measures that has sent a CAM.
inline perceived_object body_of(const cam& c, const vehicle_params& car) {
  const auto box =
      body({c.position, c.heading_rad, c.speed_mps, c.accel_mps2, 0}, car);
  return {box.centre,   box.heading_rad, c.speed_mps,
          c.accel_mps2, box.length_m,    box.width_m};
}

/// @param clock  What is told of later than now is not believed.
class planning_site final : public service_site {
public:
  explicit planning_site(std::function<time_point()> clock)
      : clock_{std::move(clock)} {}

  void hear(const cam& c) override {
    if (is_of_future(c.at, clock_()))
      return;
    const std::lock_guard lock{mutex_};
    model_.hear(c.at, c.station, body_of(c, {}));
    std::erase_if(
        told_, [&](const auto& x) { return x.second.at + remembered < c.at; });
    auto& newest = told_[c.station];
    if (newest.at <= c.at)
      newest = c;
  }

  void see(time_point at, std::span<const perceived_object> seen) override {
    if (is_of_future(at, clock_()))
      return;
    const std::lock_guard lock{mutex_};
    model_.update(at, seen);
  }

  /// @returns what a vehicle told of itself last, if that was of late.
  std::optional<cam> told_by(station_id who) const {
    const std::lock_guard lock{mutex_};
    const auto x = told_.find(who);
    return x == told_.end() ? std::nullopt : std::optional{x->second};
  }

  /// Copies what is known now.
  void tracks(std::vector<track>& out) const {
    const std::lock_guard lock{mutex_};
    out.assign(model_.tracks().begin(), model_.tracks().end());
  }

private:
  static constexpr duration remembered = std::chrono::seconds{10};

  std::function<time_point()> clock_;
  mutable std::mutex mutex_;
  // Told by CAMs and CPMs, which come when there is news.
  environment_model model_{{}, {generation::moved_m, generation::longest}};
  std::map<station_id, cam> told_; // the newest CAM of each
};

} // namespace sofof
