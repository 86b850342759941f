// A made-up town: streets in a grid, for experiments with many vehicles.
#include "world/roads/street_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sofof::world {

namespace {

/// Streets end this far from their junction's centre, m: enough for right
/// turns with a radius of more than 6 m.
constexpr auto junction_m = 15.0;

/// Distance between points of straight lanes and of turns, m.
constexpr auto straight_step_m = 5.0;
constexpr auto turn_step_m = 2.5;

/// Any place will do for the frame; this is the one of the pilot crossing.
constexpr geo_origin anchor{571656, 5364810, 32, 48.43236, 9.96873};

/// Ranks add up.
constexpr auto left_turn_rank = 1;
constexpr auto north_south_rank = 2;

enum heading { east, north, west, south };
constexpr std::array headings{east, north, west, south};

heading left_of(heading h) {
  return static_cast<heading>((h + 1) % 4);
}

heading right_of(heading h) {
  return static_cast<heading>((h + 3) % 4);
}

point unit(heading h) {
  constexpr point units[]{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return units[h];
}

struct junction {
  std::int64_t column, row;
};

junction step(junction from, heading to) {
  constexpr junction steps[]{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return {from.column + steps[to].column, from.row + steps[to].row};
}

std::string street_name(junction from, heading to) {
  return fmt::format("{}.{}{}", from.column, from.row, "enws"[to]);
}

std::string connector_name(junction at, heading in, heading out) {
  return fmt::format("{}.{}{}>{}", at.column, at.row, "enws"[in], "enws"[out]);
}

std::vector<point> straight(point from, point to) {
  const auto count = std::ceil(distance_m(from, to) / straight_step_m);
  std::vector<point> points;
  for (auto i = 0.0; i <= count; ++i)
    points.push_back(from + (i / count) * (to - from));
  return points;
}

/// A quarter turn over (0, 0) to (1, 1) that starts along x and ends along y.
/// Its curvature rises from 0 and falls back like a squared sine.
/// @param share  Of its length, in [0, 1].
point quarter_turn(double share) {
  constexpr auto pi = std::numbers::pi;
  constexpr auto slices = 64;
  auto integrate = [](double to) {
    point sum;
    for (auto i = 0; i < slices; ++i) {
      const auto s = to * (i + 0.5) / slices;
      const auto angle = pi / 2 * s - std::sin(2 * pi * s) / 4;
      sum = sum + (to / slices) * point{std::cos(angle), std::sin(angle)};
    }
    return sum;
  };
  static const auto reach = integrate(1).x_m;
  return (1 / reach) * integrate(share);
}

std::vector<point> turn(point from, point to, heading in, heading out) {
  const auto way = to - from;
  const auto ahead = dot(way, unit(in)) * unit(in);
  const auto aside = dot(way, unit(out)) * unit(out);
  const auto count = std::ceil(distance_m(from, to) / turn_step_m);
  std::vector<point> points{from};
  for (auto i = 1.0; i < count; ++i) {
    const auto [x, y] = quarter_turn(i / count);
    points.push_back(from + x * ahead + y * aside);
  }
  points.push_back(to);
  return points;
}

/// Lays out lanes and routes.
class town_plan {
public:
  explicit town_plan(const street_grid_params& params) : params_{params} {}

  std::vector<lane> lanes() const {
    std::vector<lane> all;
    for (auto r = 0; r < params_.rows; ++r)
      for (auto c = 0; c < params_.columns; ++c)
        for (const auto h : headings) {
          const junction here{c, r};
          if (exists(step(here, h)))
            all.push_back(street(here, h));
          if (exists(step(here, left_of(left_of(h)))))
            for (const auto out : ways_on(here, h))
              all.push_back(connector(here, h, out));
        }
    return all;
  }

  /// Lanes of the way round a rectangle of blocks.
  /// @param corner  The south-west one.
  std::vector<std::string> round(junction corner, std::int64_t wide,
                                 std::int64_t high, bool clockwise) const {
    std::vector<std::string> names;
    auto h = clockwise ? north : east;
    for (auto side = 0; side < 4; ++side) {
      const auto blocks = h == north || h == south ? high : wide;
      const auto turned = clockwise ? right_of(h) : left_of(h);
      for (auto i = 1; i <= blocks; ++i) {
        names.push_back(street_name(corner, h));
        corner = step(corner, h);
        names.push_back(connector_name(corner, h, i < blocks ? h : turned));
      }
      h = turned;
    }
    return names;
  }

private:
  bool exists(junction j) const {
    return 0 <= j.column && j.column < params_.columns && 0 <= j.row
           && j.row < params_.rows;
  }

  std::vector<heading> ways_on(junction at, heading in) const {
    std::vector<heading> ways{right_of(in), in, left_of(in)};
    std::erase_if(ways, [&](heading out) { return !exists(step(at, out)); });
    return ways;
  }

  /// Where lanes of a heading cross the rim of a junction.
  /// @param side  -1 on the way in, 1 on the way out.
  point gate(junction at, heading h, int side) const {
    const point centre{static_cast<double>(at.column) * params_.block_m,
                       static_cast<double>(at.row) * params_.block_m};
    return centre + (side * junction_m) * unit(h)
           + params_.half_width_m * unit(right_of(h));
  }

  lane street(junction from, heading h) const {
    const auto to = step(from, h);
    lane l = make(street_name(from, h),
                  straight(gate(from, h, 1), gate(to, h, -1)), h);
    for (const auto out : ways_on(to, h))
      l.next.push_back(connector_name(to, h, out));
    return l;
  }

  lane connector(junction at, heading in, heading out) const {
    const auto from = gate(at, in, -1), to = gate(at, out, 1);
    lane l = make(connector_name(at, in, out),
                  in == out ? straight(from, to) : turn(from, to, in, out), in);
    if (out == left_of(in))
      l.rank += left_turn_rank;
    l.next.push_back(street_name(at, out));
    return l;
  }

  lane make(std::string name, std::vector<point> centre, heading h) const {
    const auto rank = h == north || h == south ? north_south_rank : 0;
    return {std::move(name),
            std::move(centre),
            params_.half_width_m,
            {{0, params_.limit_mps}},
            {},
            rank,
            {}};
  }

  const street_grid_params& params_;
};

/// Rectangles that tours go round, in turn; every third the other way.
struct tour {
  std::int64_t wide, high;
  bool clockwise;
};
constexpr tour tours[]{{2, 1, true}, {3, 2, true}, {2, 3, false},
                       {1, 3, true}, {2, 2, true}, {4, 2, false}};

std::vector<route_ptr> plan_routes(const street_grid_params& params,
                                   const town_plan& plan, const road_map& map) {
  const auto columns = params.columns - 1, rows = params.rows - 1;
  std::vector<route_ptr> routes;
  auto add = [&](std::string name, const std::vector<std::string>& lanes) {
    routes.push_back(map.make_route(std::move(name), lanes, true));
  };
  std::size_t number = 0;
  for (auto r = 0; r < rows; ++r)
    for (auto c = 0; c < columns; ++c) {
      add(fmt::format("block {}.{}", c, r), plan.round({c, r}, 1, 1, true));
      if ((c + r) % 2 != 0)
        continue;
      const auto& t = tours[number % std::size(tours)];
      const auto wide = std::min(t.wide, columns);
      const auto high = std::min(t.high, rows);
      const junction corner{std::min<std::int64_t>(c, columns - wide),
                            std::min<std::int64_t>(r, rows - high)};
      add(fmt::format("tour {}", number++),
          plan.round(corner, wide, high, t.clockwise));
    }
  return routes;
}

template <class Number>
void check(std::string_view what, Number value, option_visitor::range r) {
  const auto x = static_cast<double>(value);
  if (!(r.min <= x && x <= r.max))
    throw std::invalid_argument{fmt::format(
        "A street grid's {} must be between {} and {}.", what, r.min, r.max)};
}

} // namespace

streets_ptr make_street_grid(const street_grid_params& params) {
  check("columns", params.columns, params.sizes);
  check("rows", params.rows, params.sizes);
  check("block_m", params.block_m, params.blocks_m);
  check("limit_mps", params.limit_mps, params.limits_mps);
  check("half_width_m", params.half_width_m, params.half_widths_m);
  const town_plan plan{params};
  streets town{{"street_grid", anchor, plan.lanes()}, {}};
  town.routes = plan_routes(params, plan, town.map);
  return std::make_shared<const streets>(std::move(town));
}

} // namespace sofof::world
