// From a plan to what an MCM says.
#include "messages/etsi/units.hpp"
#include "messages/v2x/mcm/maneuver.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace sofof::messages {
namespace {

constexpr std::int32_t farthest_cm = 131071;
constexpr std::int32_t latest_ms = 65535;
constexpr double largest_speed_mps = 163.82;

/// How far waypoints are apart where the jerk jumps by less than that.
struct density {
  double jump_mps3;
  int gap_ms;
};
constexpr density usual{0.7, 200};
constexpr density dense{4, 100};
constexpr int densest_ms = 50;
/// A waypoint may stand an eighth of the gap from where it is due: so many
/// places are looked at.
constexpr int looks = 16;
constexpr int half = looks / 2; // to either side
constexpr int looks_per_gap = 8 * half;

/// @returns the nearest whole number, ties up; of |x| > 1e9 that.
std::int32_t whole(double x) {
  return static_cast<std::int32_t>(std::clamp(std::floor(x + 0.5), -1e9, 1e9));
}

/// Distance to the nearest whole number; |x| < 1000.
float miss(float x) {
  constexpr float offset = 1000; // truncation becomes rounding
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return x + offset - static_cast<float>(static_cast<int>(x + offset + 0.5F));
}

class writer {
public:
  writer(const world::trajectory& plan, const maneuver_frame& frame)
      : plan_{plan}, origin_{frame.reference}, east_{frame.earth.to_map_axes(
                                                   {100, 0}, frame.reference)},
        north_{frame.earth.to_map_axes({0, 100}, frame.reference)},
        first_ms_{std::chrono::ceil<std::chrono::milliseconds>(
                      plan.start - frame.generated)
                      .count()},
        late_s_{to_seconds(std::chrono::milliseconds{first_ms_}
                           - (plan.start - frame.generated))},
        step_ms_{1e3 * plan.points[1].t_s}, length_ms_{whole(
                                                1e3 * plan.points.back().t_s)} {
  }

  bool fits() const {
    return first_ms_ >= 0 && first_ms_ + length_ms_ <= latest_ms
           && length_ms_ > 0;
  }
  int first_ms() const { return static_cast<int>(first_ms_); }
  int length_ms() const { return length_ms_; }

  /// @param ms  Since the first whole millisecond.
  world::trajectory_point moment(int ms) const {
    const auto t_s = late_s_ + 1e-3 * ms;
    auto p = plan_.at(t_s);
    // The last waypoint may be half a millisecond later than the plan's end.
    const auto beyond_s = t_s - plan_.points.back().t_s;
    if (beyond_s > 0)
      p.at = p.at
             + beyond_s * p.speed_mps
                   * point{std::cos(p.heading_rad), std::sin(p.heading_rad)};
    return p;
  }

  bool write(int ms, maneuver_waypoint& out) const {
    const auto p = moment(ms);
    const auto at = offset(p);
    out = {whole(at.x_m), whole(at.y_m), first_ms() + ms,
           whole(100 * p.speed_mps)};
    return std::abs(out.x_cm) <= farthest_cm
           && std::abs(out.y_cm) <= farthest_cm
           && p.speed_mps < largest_speed_mps;
  }

  /// @returns where the next waypoint stands, at least about `least_gap`
  /// behind the one at `ms`, which is not the last.
  int next_ms(int ms, int least_gap) const;

  /// @returns how far points are apart that are equally far.
  int even_gap_ms() const {
    auto gap = usual.gap_ms;
    for (int ms = 0; ms < length_ms_; ms += usual.gap_ms)
      gap = std::min(gap, std::max(gap_ms(ms), dense.gap_ms));
    return gap;
  }

private:
  static constexpr double slack = 0.02; // of a step

  /// @returns how far the next waypoint may be from the one at `ms`.
  int gap_ms(int ms) const {
    // One before and one behind what the usual gap spans: curves bend early.
    const auto k = knot(ms);
    const auto last = std::min(knot(ms + usual.gap_ms) + 1, size() - 2);
    auto jump = 0.0;
    for (auto i = std::max(k, std::size_t{1}); i <= last; ++i)
      if (!stands(i) && !stands(i + 1)) // a rest begins as it does
        jump =
            std::max(jump, std::abs(accel(i + 1) - 2 * accel(i) + accel(i - 1))
                               / (1e-3 * step_ms_));
    return jump < usual.jump_mps3   ? usual.gap_ms
           : jump < dense.jump_mps3 ? dense.gap_ms
                                    : densest_ms;
  }

  /// @returns the end of the rest at `ms`; `ms` if there is none.
  int rest_until_ms(int ms) const {
    auto k = knot(ms);
    if (!stands(k))
      return ms;
    while (k + 1 < size() && stands(k + 1))
      ++k;
    return std::min(time_ms(k), length_ms_);
  }

  /// @returns the plan's last point before the car comes to rest, or that of
  /// the rest if the car is beyond; nothing if it does not rest before
  /// the interval of `until_ms` is over.
  std::optional<int> last_before_rest_ms(int ms, int until_ms) const {
    const auto end = std::min(knot(until_ms) + 1, size() - 1);
    for (auto k = knot(ms); k < end; ++k)
      if (stands(k + 1))
        return time_ms(ms < time_ms(k) ? k : k + 1);
    return {};
  }

  int best_near(int ms, int look_ms) const;

  /// @returns the unit vector of a heading between two points of the plan,
  /// from their chord: sine and cosine would take longer.
  point direction(const world::trajectory_point& p, std::size_t k) const {
    const auto& a = plan_.points[k];
    const auto& b = plan_.points[k + 1];
    const auto chord_m = distance_m(a.at, b.at);
    constexpr double shortest_m = 0.01;
    if (chord_m < shortest_m)
      return {std::cos(p.heading_rad), std::sin(p.heading_rad)};
    const auto along = 1 / chord_m * (b.at - a.at);
    const auto turned = p.heading_rad - (a.heading_rad + b.heading_rad) / 2;
    return (1 - turned * turned / 2) * along
           + turned * point{-along.y_m, along.x_m};
  }

  /// In cm to the east and north of the reference.
  point east_north(point v) const { return {dot(east_, v), dot(north_, v)}; }
  point offset(const world::trajectory_point& p) const {
    return east_north(p.at - origin_);
  }

  std::size_t size() const { return plan_.points.size(); }
  std::size_t knot(int ms) const {
    return std::min(static_cast<std::size_t>(ms / step_ms_ + slack),
                    size() - 1);
  }
  int time_ms(std::size_t knot) const {
    return whole(static_cast<double>(knot) * step_ms_);
  }
  double accel(std::size_t i) const { return plan_.points[i].accel_mps2; }
  /// @returns whether it stands as far as the message can tell.
  bool stands(std::size_t i) const {
    constexpr double walking_mps = 1; // faster cars need no closer look
    return plan_.points[i].speed_mps < walking_mps
           && whole(100 * moment(time_ms(i)).speed_mps) == 0;
  }

  const world::trajectory& plan_;
  point origin_, east_, north_;
  std::int64_t first_ms_; // since the message was generated
  double late_s_;         // ... which is so long after the plan's start
  double step_ms_;
  int length_ms_;
};

/// @returns the moment about `ms` at which rounding costs least: the plan as a
/// polynomial in time, compared with whole numbers every `look_ms`
int writer::best_near(int ms, int look_ms) const {
  const auto p = moment(ms);
  const auto k = std::min(knot(ms), size() - 2);
  const auto tangent = direction(p, k);
  const point left{-tangent.y_m, tangent.x_m};
  const auto at = offset(p);
  const auto velocity = p.speed_mps * tangent;
  const auto push = p.accel_mps2 * tangent
                    + p.speed_mps * p.speed_mps * p.curvature_1pm * left;
  const auto along = east_north(1e-3 * velocity);
  const auto bend = east_north(0.5e-6 * push);
  const auto side = east_north(0.01 * left);
  const auto jerk = (accel(k + 1) - accel(k)) / step_ms_;

  const auto f = [](double x) { return static_cast<float>(x); };
  const auto x0 = f(at.x_m - whole(at.x_m)), x1 = f(along.x_m),
             x2 = f(bend.x_m);
  const auto y0 = f(at.y_m - whole(at.y_m)), y1 = f(along.y_m),
             y2 = f(bend.y_m);
  const auto v0 = f(100 * p.speed_mps - whole(100 * p.speed_mps)),
             v1 = f(0.1 * p.accel_mps2), v2 = f(0.05 * jerk);
  const auto left_x = f(side.x_m), left_y = f(side.y_m);

  // The number of the look stands in the last bits of what it costs, so that
  // the least of these numbers tells both.
  static_assert(std::has_single_bit(unsigned{looks}));
  auto best = std::numeric_limits<std::int32_t>::max();
#pragma omp simd reduction(min : best)
  for (int i = 0; i < looks; ++i) {
    const auto t = static_cast<float>(look_ms * (i - half));
    const auto x = miss(x0 + t * (x1 + t * x2));
    const auto y = miss(y0 + t * (y1 + t * y2));
    const auto v = miss(v0 + t * (v1 + t * v2));
    const auto beside = left_x * x + left_y * y;
    constexpr float tie = 1e-8F; // in the middle, if it is all the same
    const auto cost = beside * beside + v * v + tie * t * t;
    const auto numbered =
        (std::bit_cast<std::int32_t>(cost) & ~(looks - 1)) | i;
    best = std::min(best, numbered);
  }
  return ms + look_ms * ((best & (looks - 1)) - half);
}

int writer::next_ms(int ms, int least_gap) const {
  if (const auto rested = rest_until_ms(ms); rested > ms)
    return rested;
  const auto gap = std::max(gap_ms(ms), least_gap);
  const auto look_ms = std::max(1, std::min(gap, usual.gap_ms) / looks_per_gap);
  const auto next = ms + gap;
  const auto latest = next + look_ms * half;
  if (const auto last = last_before_rest_ms(ms, latest);
      last && *last <= latest)
    return std::clamp(*last, ms + 1, length_ms_);
  if (next + gap / 2 >= length_ms_)
    return length_ms_;
  return best_near(next, look_ms);
}

} // namespace

bool to_waypoints(const world::trajectory& plan, const maneuver_frame& frame,
                  std::vector<maneuver_waypoint>& out) {
  out.clear();
  if (!plan.is_sound())
    return false;
  const writer pen{plan, frame};
  if (!pen.fits())
    return false;
  const auto end = pen.length_ms();
  for (int ms = 0;;) {
    maneuver_waypoint x;
    if (!pen.write(ms, x)) {
      out.clear();
      return false;
    }
    out.push_back(x);
    if (ms == end)
      return true;
    // Long plans get wider gaps; two waypoints are kept for stops.
    const auto left = static_cast<int>(most_waypoints - out.size()) - 2;
    ms = left > 0 ? pen.next_ms(ms, (end - ms) / left + 1) : end;
  }
}

bool to_planned_points(const world::trajectory& plan,
                       const maneuver_frame& frame, planned_points& out) {
  out.points.clear();
  if (!plan.is_sound())
    return false;
  const writer pen{plan, frame};
  if (!pen.fits())
    return false;
  auto step = pen.even_gap_ms();
  step = std::max(step, pen.length_ms() / static_cast<int>(most_waypoints) + 1);
  constexpr int largest_step_ms = 255;
  if (step > largest_step_ms)
    return false;
  step = std::min(step, pen.length_ms());
  out.start_ms = pen.first_ms();
  out.step_ms = step;
  for (int ms = 0; ms <= pen.length_ms(); ms += step) {
    maneuver_waypoint x;
    if (!pen.write(ms, x)) {
      out.points.clear();
      return false;
    }
    out.points.push_back({x.x_cm, x.y_cm, x.speed_cmps,
                          frame.earth.to_etsi_heading(
                              pen.moment(ms).heading_rad, frame.reference)});
  }
  return true;
}

} // namespace sofof::messages
