// Random roads for property tests: bends that tighten and open.
#pragma once

#include "base/random.hpp"
#include "tests/planners/test_drive.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sofof::test {

/// An open road; curvature is linear between random values, limits change now
/// and then.
inline world::route_ptr random_road(std::uint64_t seed, double length_m = 500,
                                    double least_radius_m = 15) {
  const random_stream chance{seed, "road"};
  constexpr double step_m = 0.1, piece_m = 25;
  constexpr int steps_per_point = 20; // one every 2 m
  std::vector<point> points;
  point at;
  auto heading = chance.uniform(-3, 3, 0, 1);
  auto from = 0.0, to = 0.0;
  std::uint64_t piece = 0;
  for (auto i = 0; i * step_m <= length_m; ++i) {
    const auto s = i * step_m;
    if (s >= static_cast<double>(piece) * piece_m) {
      from = to;
      ++piece;
      const auto bends = chance.uniform(piece, 1) < 0.6;
      to = bends ? chance.uniform(-1, 1, piece, 2) / least_radius_m : 0;
    }
    const auto share = s / piece_m - static_cast<double>(piece - 1);
    if (i % steps_per_point == 0)
      points.push_back(at);
    const auto turn = step_m * std::lerp(from, to, share);
    const auto mid = heading + turn / 2;
    at = at + step_m * point{std::cos(mid), std::sin(mid)};
    heading += turn;
  }
  std::vector<world::speed_zone> limits;
  for (std::uint64_t n = 0; static_cast<double>(n) * 120 < length_m; ++n)
    limits.push_back(
        {static_cast<double>(n) * 120, chance.uniform(5, 20, n, 3)});
  return make_route(std::move(points), std::move(limits), false);
}

} // namespace sofof::test
