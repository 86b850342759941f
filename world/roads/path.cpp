// A smooth line through given points, addressed by arc length.
#include "world/roads/path.hpp"

#include "base/spline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sofof::world {

namespace {

constexpr auto table_step_m = 0.5;
/// A guess is good that is no farther off.
constexpr auto good_guess_m = 1.0;

/// @returns whether points are in a row, one behind the other: the spline
/// through them is a straight line.
bool are_straight(std::span<const point> points) {
  constexpr auto enough_m = 1e-9;
  const auto chord = points.back() - points.front();
  const auto length_m = distance_m(points.front(), points.back());
  auto last_m = -1.0;
  return std::ranges::all_of(points, [&](point p) {
    const auto to = p - points.front();
    const auto along_m = dot(chord, to) / length_m;
    return std::abs(cross(chord, to)) <= enough_m * length_m
           && along_m > std::exchange(last_m, along_m);
  });
}

/// Where the spline has which arc length: short intervals of its pieces.
class ruler {
public:
  explicit ruler(std::span<const cubic_piece> pieces) {
    for (const auto& piece : pieces) {
      knots_m_.push_back(length_m_);
      const auto n = std::ceil(piece.chord_m / table_step_m);
      const auto width = piece.chord_m / n;
      for (auto i = 0.0; i < n; ++i) {
        marks_.push_back({&piece, i * width, length_m_});
        length_m_ += piece.length_m(i * width, (i + 1) * width);
      }
    }
    knots_m_.push_back(length_m_);
  }

  double length_m() const { return length_m_; }
  const std::vector<double>& knots_m() const { return knots_m_; }

  struct spot {
    const cubic_piece* piece;
    double u;
  };

  /// @param s_m  Not smaller than in the call before.
  spot find(double s_m) {
    while (next_ + 1 < marks_.size() && marks_[next_ + 1].s_m <= s_m)
      ++next_;
    const auto& mark = marks_[next_];
    auto u = mark.from + (s_m - mark.s_m);
    constexpr auto enough_m = 1e-9;
    for (auto newton = 0; newton < 4; ++newton) {
      const auto miss_m = mark.s_m + mark.piece->length_m(mark.from, u) - s_m;
      if (std::abs(miss_m) < enough_m)
        break;
      const auto v = mark.piece->slope(u);
      u -= miss_m / std::sqrt(dot(v, v));
    }
    return {mark.piece, u};
  }

private:
  struct mark {
    const cubic_piece* piece;
    double from; // parameter
    double s_m;
  };
  std::vector<mark> marks_;
  std::vector<double> knots_m_;
  double length_m_ = 0;
  std::size_t next_ = 0;
};

} // namespace

path::path(std::span<const point> points, bool closed) : closed_{closed} {
  const auto pieces = fit_spline(points, closed);
  ruler tape{pieces};
  length_m_ = tape.length_m();
  knots_m_.assign(tape.knots_m().begin(),
                  tape.knots_m().begin() + std::ssize(points));
  const auto count = !closed && are_straight(points)
                         ? 1.0
                         : std::max(1.0, std::round(length_m_ / table_step_m));
  step_m_ = length_m_ / count;
  steps_per_m_ = count / length_m_;
  table_.reserve(static_cast<std::size_t>(count) + 1);
  auto heading_rad = 0.0;
  for (auto i = 0.0; i <= count; ++i) {
    const auto [piece, u] = tape.find(std::min(i * step_m_, length_m_));
    const auto slope = piece->slope(u);
    const auto speed = std::hypot(slope.x_m, slope.y_m);
    heading_rad += wrap_angle(std::atan2(slope.y_m, slope.x_m) - heading_rad);
    table_.push_back({piece->at(u), (1 / speed) * slope, heading_rad,
                      cross(slope, piece->bend(u)) / (speed * speed * speed)});
  }
  turn_rad_ = table_.back().heading_rad - table_.front().heading_rad;
  for (const auto& x : table_)
    sharpest_1pm_ = std::max(sharpest_1pm_, std::abs(x.curvature_1pm));
}

/// @returns where the foot of the perpendicular is, seen from `s_m`.
double path::next_to(const view& seen, double s_m) {
  constexpr double least_slope = 0.1;
  return s_m
         + seen.along_m
               / std::max(least_slope, 1 - seen.curvature_1pm * seen.left_m);
}

path_offset path::project(point p, double s_guess_m, double window_m) const {
  assert(!table_.empty());
  auto laps_m = 0.0;
  if (closed_) {
    if (!(0 <= s_guess_m && s_guess_m < length_m_))
      laps_m = std::floor(s_guess_m / length_m_) * length_m_;
    s_guess_m -= laps_m;
    window_m = std::min(window_m, length_m_ / 2);
  }
  auto low_m = s_guess_m - window_m, high_m = s_guess_m + window_m;
  if (!closed_) {
    low_m = std::clamp(low_m, 0.0, length_m_);
    high_m = std::clamp(high_m, 0.0, length_m_);
    s_guess_m = std::clamp(s_guess_m, low_m, high_m);
  }
  const auto seen = look(p, s_guess_m);
  const auto start_m = std::clamp(next_to(seen, s_guess_m), low_m, high_m);
  if (is_nearest_about(seen, window_m)) {
    constexpr auto per_chord = 1.1; // of arcs that are not longer than that
    const auto reach_m = 2 * per_chord * std::abs(seen.left_m) + good_guess_m;
    const auto foot = refine(p, start_m, std::max(low_m, start_m - reach_m),
                             std::min(high_m, start_m + reach_m));
    return {laps_m + foot.s_m, foot.d_m, foot.beyond_m};
  }
  const auto near_m = step_m_ * nearest_entry(p, start_m, low_m, high_m);
  const auto foot = refine(p, std::clamp(near_m, low_m, high_m),
                           std::max(low_m, near_m - step_m_),
                           std::min(high_m, near_m + step_m_));
  return {laps_m + foot.s_m, foot.d_m, foot.beyond_m};
}

/// @returns whether a point that is seen like this from the guess is nearest
/// to the path about there, whatever the path does in the window: who is never
/// sharper than a circle does not come back as near (Schur 1921), until it has
/// gone round most of it.
bool path::is_nearest_about(const view& seen, double window_m) const {
  constexpr double most_of_a_circle_rad = 5;
  constexpr double near_share = 0.5; // of the way to the circle's centre
  return std::abs(seen.along_m) < good_guess_m
         && std::abs(seen.left_m) * sharpest_1pm_ < near_share
         && (window_m + good_guess_m) * sharpest_1pm_ < most_of_a_circle_rad;
}

/// Number of the nearest entry of the table in a stretch, counted from the
/// start of the lap: possibly negative, or beyond the lap.
double path::nearest_entry(point p, double start_m, double low_m,
                           double high_m) const {
  const auto count = static_cast<std::int64_t>(table_.size()) - 1;
  auto entry_at = [&](double s_m) {
    return static_cast<std::int64_t>(std::floor(s_m * steps_per_m_ + 0.5));
  };
  auto away_m = [&](std::int64_t i) {
    const auto on_lap = i < 0 ? i + count : i > count ? i - count : i;
    return distance_m(p, table_[static_cast<std::size_t>(on_lap)].at);
  };
  const auto start = entry_at(start_m);
  const auto start_away_m = away_m(start);
  auto best = start;
  auto best_away_m = start_away_m;
  // The distance changes by at most a metre a metre, so wherever it exceeds
  // the best one by x, the next x metres need not be looked at.
  auto march = [&](std::int64_t sign, std::int64_t last) {
    auto excess_m = 0.0;
    for (auto i = start; i != last;) {
      const auto skip = static_cast<std::int64_t>(excess_m * steps_per_m_);
      i += sign * std::max<std::int64_t>(skip, 1);
      if (sign * (last - i) < 0)
        return;
      const auto here_m = away_m(i);
      if (here_m < best_away_m)
        best = i, best_away_m = here_m;
      excess_m = here_m - best_away_m;
    }
  };
  march(1, entry_at(high_m));
  march(-1, entry_at(low_m));
  return static_cast<double>(best);
}

path_offset path::project(point p) const {
  return project(p, length_m_ / 2, length_m_ / 2);
}

/// Newton's method for the foot of the perpendicular, kept in its bracket.
path_offset path::refine(point p, double s_m, double low_m,
                         double high_m) const {
  constexpr auto enough_m = 1e-3; // the next step would be its square
  auto seen = look(p, s_m);
  for (auto i = 0; i < 20; ++i) {
    (seen.along_m > 0 ? low_m : high_m) = s_m;
    const auto next_m = std::clamp(next_to(seen, s_m), low_m, high_m);
    const auto moved_m = std::abs(next_m - s_m);
    s_m = next_m;
    if (moved_m < enough_m)
      break;
    seen = look(p, s_m);
  }
  return {s_m, seen.left_m, seen.along_m};
}

} // namespace sofof::world
