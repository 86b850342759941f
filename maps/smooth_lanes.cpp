// Draws the lanes of a source so that a car can follow them.
#include "maps/smooth_lanes.hpp"

#include "world/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include "maps/p_spline.hpp"
#include "maps/polyline.hpp"
#include "maps/swept_body.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

namespace sofof::maps {

namespace {

/// A lane of a junction that turns by more may begin on the lane before it.
constexpr auto turn_rad = 0.3;
constexpr auto room_to_turn_m = 3.5;

/// What lanes that still bend too sharply get besides, and how often.
constexpr auto more_room_m = 6.0;
constexpr auto most_rounds = 2;

/// A lane keeps so much of itself.
constexpr auto least_left_m = 12.0;

/// How far a lane may be drawn from its source, m.
constexpr auto off_outside_m = 0.15, off_inside_m = 0.45;

/// Where a car could not follow, its rear axle may be as far off as its body
/// stays within the source's lane, and so much more, m.
constexpr auto over_rim_m = 0.15;

using lane_list = std::vector<std::size_t>;

double total_turn_rad(std::span<const point> line) {
  const auto in = direction_at_start(line), out = direction_at_end(line);
  return std::abs(std::atan2(cross(in, out), dot(in, out)));
}

/// Both ends of each lane: 2i is where lane i begins, 2i + 1 where it ends.
/// Ends that meet are one joint.
class joints {
public:
  joints(std::size_t lanes, const std::vector<lane_list>& next)
      : parent_(2 * lanes), of_(2 * lanes) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t i = 0; i < lanes; ++i)
      for (const auto j : next[i])
        parent_[root(2 * i + 1)] = root(2 * j);
  }

  /// Lanes outside of junctions say where a joint is, if there are any.
  void place(const std::vector<source_lane>& lanes) {
    for (const auto inside : {false, true})
      for (std::size_t end = 0; end < parent_.size(); ++end)
        if (const auto& l = lanes[end / 2]; l.inside == inside)
          add(of_[root(end)], l, end % 2 == 1);
  }

  point at(std::size_t end) { return mean(end).at; }
  point direction(std::size_t end) { return mean(end).direction; }

private:
  struct joint {
    point at, direction;
    double count = 0;
    bool inside = false;
  };

  static void add(joint& to, const source_lane& l, bool is_end) {
    if (to.count > 0 && to.inside != l.inside)
      return;
    to.inside = l.inside;
    to.count += 1;
    to.at = to.at + (is_end ? l.centre.back() : l.centre.front());
    to.direction =
        to.direction
        + (is_end ? direction_at_end(l.centre) : direction_at_start(l.centre));
  }

  joint mean(std::size_t end) {
    auto x = of_[root(end)];
    assert(x.count > 0);
    x.at = (1 / x.count) * x.at;
    const auto size = std::sqrt(dot(x.direction, x.direction));
    x.direction = size > 0 ? (1 / size) * x.direction : point{1, 0};
    return x;
  }

  std::size_t root(std::size_t end) {
    while (parent_[end] != end)
      end = parent_[end] = parent_[parent_[end]];
    return end;
  }

  std::vector<std::size_t> parent_;
  std::vector<joint> of_; // sums, at the roots
};

class draughtsman {
public:
  explicit draughtsman(const source_map& map)
      : lanes_{map.lanes}, next_(lanes_.size()), previous_(lanes_.size()) {
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      index.emplace(lanes_[i].name, i);
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      for (const auto& name : lanes_[i].next) {
        const auto j = index.at(name);
        next_[i].push_back(j);
        previous_[j].push_back(i);
      }
  }

  /// Lanes of junctions that bend too sharply get more room, twice.
  std::vector<drawn_lane> draw() {
    std::vector<double> room_m(lanes_.size(), 0.0);
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (lanes_[i].inside && total_turn_rad(lanes_[i].centre) > turn_rad)
        room_m[i] = room_to_turn_m;
    const auto source = lanes_;
    for (auto rounds = 0;; ++rounds) {
      auto drawn = draw(room_m);
      auto is_done = true;
      for (std::size_t i = 0; i < drawn.size(); ++i)
        if (lanes_[i].inside && !drawn[i].is_drivable()) {
          room_m[i] += more_room_m;
          is_done = false;
        }
      if (is_done || rounds == most_rounds)
        return drawn;
      lanes_ = source;
    }
  }

private:
  std::vector<drawn_lane> draw(const std::vector<double>& room_m) {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (!lanes_[i].inside)
        lend(i, room_m);
    joints all{lanes_.size(), next_};
    all.place(lanes_);
    std::vector<drawn_lane> drawn;
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      try {
        drawn.push_back(draw(i, all));
      } catch (const std::invalid_argument& problem) {
        throw std::invalid_argument{
            fmt::format("lane \"{}\": {}", lanes_[i].name, problem.what())};
      }
    return drawn;
  }

  /// @returns how much of a lane those at its end need; none if one of them
  /// is not in a junction, or begins at other lanes, too.
  double wanted_m(const lane_list& around, const std::vector<lane_list>& back,
                  const std::vector<double>& room_m) const {
    auto most = 0.0;
    for (const auto j : around) {
      if (!lanes_[j].inside || back[j].size() != 1)
        return 0;
      most = std::max(most, room_m[j]);
    }
    return most;
  }

  /// Gives the ends of a lane to the turns before and behind it.
  void lend(std::size_t i, const std::vector<double>& room_m) {
    auto& line = lanes_[i].centre;
    const auto length = length_m(line);
    const auto to_give_m = std::max(0.0, (length - least_left_m) / 2);
    const auto from_m =
        std::min(to_give_m, wanted_m(previous_[i], next_, room_m));
    const auto to_m =
        length - std::min(to_give_m, wanted_m(next_[i], previous_, room_m));
    if (from_m > 0) {
      const auto part = part_of(line, 0, from_m);
      for (const auto j : previous_[i]) {
        auto& turn = lanes_[j].centre;
        turn.insert(turn.end(), part.begin() + 1, part.end());
      }
    }
    if (to_m < length) {
      const auto part = part_of(line, to_m, length);
      for (const auto j : next_[i]) {
        auto& turn = lanes_[j].centre;
        turn.insert(turn.begin(), part.begin(), part.end() - 1);
      }
    }
    if (from_m > 0 || to_m < length)
      line = part_of(line, from_m, to_m);
  }

  drawn_lane draw(std::size_t i, joints& all) const {
    const auto& from = lanes_[i];
    const curve_ends ends{all.at(2 * i), all.direction(2 * i),
                          all.at(2 * i + 1), all.direction(2 * i + 1)};
    const auto bends = total_turn_rad(from.centre) > turn_rad;
    const auto near_m = from.inside && bends ? off_inside_m : off_outside_m;
    const auto curve = draw_line(from, ends, near_m);
    drawn_lane to{.is = {.name = from.name,
                         .centre = thinned(curve.points),
                         .half_width_m = from.half_width_m,
                         .limits = {{0, from.limit_mps}},
                         .next = from.next,
                         .rank = from.rank,
                         .opposite = {}},
                  .sharpest_1pm = curve.sharpest_1pm};
    to.is.half_width_m =
        std::max(to.is.half_width_m, needed_half_width_m(to.is.centre));
    return to;
  }

  /// As smooth as near to its source is possible; a lane that a car could not
  /// follow is drawn once more, farther from it.
  static fitted_curve draw_line(const source_lane& from, const curve_ends& ends,
                                double near_m) {
    auto best = fit_p_spline(from.centre, ends, {.off_m = near_m});
    const auto rim_m =
        from.half_width_m - world::vehicle_params{}.width_m / 2 + over_rim_m;
    if (best.sharpest_1pm > sharpest_drivable_1pm && rim_m > near_m)
      if (auto other = fit_p_spline(from.centre, ends, {.off_m = rim_m});
          other.sharpest_1pm < best.sharpest_1pm)
        best = std::move(other);
    return best;
  }

  std::vector<source_lane> lanes_;
  std::vector<lane_list> next_, previous_;
};

} // namespace

std::vector<drawn_lane> draw_lanes(const source_map& map) {
  return draughtsman{map}.draw();
}

} // namespace sofof::maps
