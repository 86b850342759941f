// Bodies as observers with noise see them, for tests of tracks.
#pragma once

#include "base/random.hpp"
#include "planners/scene/object_tracker.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace sofof::test {

using namespace planners;
using namespace world;
using namespace std::chrono_literals;

inline constexpr time_point first_sight{100s};

/// As the rules for CPMs have it.
inline constexpr sighting_rhythm rhythm{4, 1s};

inline perceived_object perceived_car(point centre, double speed_mps = 0,
                                      double heading_rad = 0) {
  return {centre, heading_rad, speed_mps, 0, 5.1, 1.89};
}

/// An observer that sees with noise.
struct observer {
  explicit observer(std::uint64_t number)
      : dice{random_stream{42, "eyes"}.part(number)} {}

  perceived_object look(perceived_object o) {
    ++draws;
    o.centre.x_m += dice.normal(0, 0.1, draws, 0);
    o.centre.y_m += dice.normal(0, 0.1, draws, 1);
    o.speed_mps += dice.normal(0, 0.1, draws, 2);
    o.heading_rad += dice.normal(0, 0.01, draws, 3);
    return o;
  }

  std::vector<perceived_object> look(std::vector<perceived_object> all) {
    for (auto& o : all)
      o = look(o);
    return all;
  }

  random_stream dice;
  std::uint64_t draws = 0;
};

/// Cars bumper to bumper that pull away and stop in waves.
struct queue {
  std::vector<perceived_object> at(time_point t) const {
    std::vector<perceived_object> cars;
    const auto phase = 0.5 * to_seconds(t - first_sight);
    for (auto i = 0; i < 8; ++i)
      cars.push_back(
          perceived_car({-8.0 * i + 10 * (phase - std::sin(phase)), 0},
                        5 * (1 - std::cos(phase))));
    return cars;
  }
};

inline std::set<std::uint32_t> ids(const object_tracker& model) {
  std::set<std::uint32_t> all;
  for (const auto& x : model.tracks())
    all.insert(x.id);
  return all;
}

inline double miss_m(const track& x, point truth) {
  return distance_m(x.centre(), truth);
}

inline void see(object_tracker& model, time_point at,
                const perceived_object& o) {
  model.update(at, {&o, 1});
}

} // namespace sofof::test
