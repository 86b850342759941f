// What a provider knows of the road: all CAMs, all that its sensors and the
// vehicles it plans for see, put together.
#pragma once

#include "actors/service_kind.hpp"
#include "planners/environment_model.hpp"

#include <mutex>
#include <span>
#include <vector>

namespace sofof {

/// @returns the body of a vehicle with these measures that has sent a CAM.
inline perceived_object body_of(const cam& c, const vehicle_params& car) {
  const auto box =
      body({c.position, c.heading_rad, c.speed_mps, c.accel_mps2, 0}, car);
  return {box.centre,   box.heading_rad, c.speed_mps,
          c.accel_mps2, box.length_m,    box.width_m};
}

class planning_site final : public service_site {
public:
  void hear(const cam& c) override {
    const std::lock_guard lock{mutex_};
    model_.hear(c.at, c.station, body_of(c, {}));
  }

  void see(time_point at, std::span<const perceived_object> seen) override {
    const std::lock_guard lock{mutex_};
    model_.update(at, seen);
  }

  /// Copies what is known now.
  void tracks(std::vector<track>& out) const {
    const std::lock_guard lock{mutex_};
    out.assign(model_.tracks().begin(), model_.tracks().end());
  }

private:
  mutable std::mutex mutex_;
  environment_model model_;
};

} // namespace sofof
