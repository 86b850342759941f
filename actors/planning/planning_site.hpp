// What a provider knows of the road: all CAMs, all that its sensors and the
// vehicles it plans for see, put together.
#pragma once

#include "actors/service_kind.hpp"
#include "messages/v2x/generation_rules.hpp"
#include "planners/environment_model.hpp"

#include <functional>
#include <mutex>
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

/// Clocks of vehicles, sensors and providers agree within this.
inline constexpr duration clock_tolerance = std::chrono::milliseconds{200};

/// @returns whether something cannot have been seen yet. One such sighting
/// would make all true ones too old for an environment model.
constexpr bool is_of_future(time_point at, time_point now) {
  return at > now + clock_tolerance;
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
  }

  void see(time_point at, std::span<const perceived_object> seen) override {
    if (is_of_future(at, clock_()))
      return;
    const std::lock_guard lock{mutex_};
    model_.update(at, seen);
  }

  /// Copies what is known now.
  void tracks(std::vector<track>& out) const {
    const std::lock_guard lock{mutex_};
    out.assign(model_.tracks().begin(), model_.tracks().end());
  }

private:
  std::function<time_point()> clock_;
  mutable std::mutex mutex_;
  // Told by CAMs and CPMs, which come when there is news.
  environment_model model_{{}, {generation::moved_m, generation::longest}};
};

} // namespace sofof
