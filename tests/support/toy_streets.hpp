// Small street layouts for tests: one junction, or a grid of them.
#pragma once

#include "base/protocol.hpp"
#include "messages/protocol/motion.hpp"
#include "world/roads/road_map.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sofof::toy {

inline constexpr double limit_mps = 10;

/// Lanes begin and end this far from a junction's centre, m.
inline constexpr double corner_m = 12;

/// Points stand close, or the spline through lane after lane would swing.
inline world::lane straight(std::string name, point from, point to,
                            int rank = 0) {
  world::lane l{std::move(name), {}, 1.75, {{0, limit_mps}}, {}, rank};
  const auto pieces = std::ceil(distance_m(from, to) / 4);
  for (auto i = 0.0; i <= pieces; ++i)
    l.centre.push_back(from + (i / pieces) * (to - from));
  return l;
}

/// A bend (cubic Bézier) from one straight into another.
inline world::lane bend(std::string name, const world::lane& from,
                        const world::lane& to, int rank) {
  const auto a = from.centre.back(), d = to.centre.front();
  const auto along = [](const world::lane& l) {
    const auto v = l.centre.back() - l.centre.front();
    return (1 / std::hypot(v.x_m, v.y_m)) * v;
  };
  const auto reach_m = 0.4 * distance_m(a, d);
  const auto b = a + reach_m * along(from), c = d - reach_m * along(to);
  world::lane l{std::move(name), {}, 1.75, {{0, limit_mps}}, {to.name}, rank};
  constexpr auto pieces = 10;
  for (auto i = 0; i <= pieces; ++i) {
    const auto t = static_cast<double>(i) / pieces, u = 1 - t;
    l.centre.push_back(u * u * u * a + 3 * t * u * u * b + 3 * t * t * u * c
                       + t * t * t * d);
  }
  return l;
}

/// Where junctions stand, in metres, and which are joined by a street.
struct plan {
  std::vector<point> junctions;
  std::vector<std::pair<std::size_t, std::size_t>> streets;
};

/// One lane "a>b" in each direction of every street, one connector "a>b>c"
/// for every way over a junction, no turning back. Left turns give way
/// (rank 1); so does everybody who comes along a street of `minor` (rank 2,
/// turning left 3).
inline world::road_map build(const plan& all,
                             const std::vector<std::size_t>& minor = {}) {
  struct arm {
    std::size_t from, to;
    world::lane way;
    bool is_minor;
  };
  std::vector<arm> arms;
  for (std::size_t n = 0; n < all.streets.size(); ++n)
    for (const auto& [from, to] :
         {all.streets[n],
          std::pair{all.streets[n].second, all.streets[n].first}}) {
      const auto a = all.junctions[from], b = all.junctions[to];
      const auto along = (1 / distance_m(a, b)) * (b - a);
      const auto right = 1.75 * point{along.y_m, -along.x_m};
      arms.push_back(
          {from, to,
           straight(fmt::format("{}>{}", from, to),
                    a + corner_m * along + right, b - corner_m * along + right),
           std::ranges::count(minor, n) > 0});
    }
  std::vector<world::lane> bends;
  for (auto& in : arms)
    for (const auto& out : arms)
      if (in.to == out.from && in.from != out.to) {
        const auto u = in.way.centre.back() - in.way.centre.front();
        const auto v = out.way.centre.back() - out.way.centre.front();
        const auto left = cross(u, v) > 0.5 * std::sqrt(dot(u, u) * dot(v, v));
        bends.push_back(bend(fmt::format("{}>{}>{}", in.from, in.to, out.to),
                             in.way, out.way,
                             (in.is_minor ? 2 : 0) + (left ? 1 : 0)));
        in.way.next.push_back(bends.back().name);
      }
  for (auto& a : arms)
    bends.push_back(std::move(a.way));
  return {"toy", {}, std::move(bends)};
}

/// @returns the route over the given junctions, which are neighbours.
inline world::route_ptr make_route(const world::road_map& map,
                                   const std::vector<std::size_t>& junctions,
                                   bool closed = false) {
  std::vector<std::string> lanes;
  const auto n = junctions.size();
  for (std::size_t i = 0; i + 1 < n + (closed ? 1 : 0); ++i) {
    const auto a = junctions[i], b = junctions[(i + 1) % n],
               c = junctions[(i + 2) % n];
    lanes.push_back(fmt::format("{}>{}", a, b));
    if (closed || i + 2 < n)
      lanes.push_back(fmt::format("{}>{}>{}", a, b, c));
  }
  return map.make_route(fmt::format("{}", fmt::join(junctions, "-")), lanes,
                        closed);
}

/// Four arms (junctions 1 east, 2 north, 3 west, 4 south) around junction 0.
/// West-east has the right of way, unless `equal`.
inline world::road_map cross_roads(bool equal = false) {
  const plan all{{{0, 0}, {150, 0}, {0, 150}, {-150, 0}, {0, -150}},
                 {{0, 1}, {0, 2}, {0, 3}, {0, 4}}};
  return equal ? build(all) : build(all, {1, 3});
}

/// Junction number row * size + column, `block_m` apart.
inline world::road_map grid(std::size_t size, double block_m) {
  plan all;
  for (std::size_t i = 0; i < size * size; ++i) {
    all.junctions.push_back({block_m * static_cast<double>(i % size),
                             block_m * static_cast<double>(i / size)});
    if (i % size + 1 < size)
      all.streets.emplace_back(i, i + 1);
    if (i / size + 1 < size)
      all.streets.emplace_back(i, i + size);
  }
  return build(all);
}

/// @returns what tells the way ahead on a route, as a requester needs it.
inline auto path_ahead_on(world::route_ptr way) {
  return [way = std::move(way)](const messages::ego_state& ego) {
    return way->waypoints(ego.s_m, protocol::route_ahead_m,
                          protocol::route_spacing_m);
  };
}

} // namespace sofof::toy
