// Does what a station tells of a body fit what it told before?
#include "planners/plausibility/motion_check.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

using namespace std::chrono_literals;

/// Nothing is compared over a longer time: too much may have happened.
constexpr duration longest_gap = 2s;

/// No tyre holds more, m/s²; a vehicle may turn once round in 30 m.
constexpr auto grip_mps2 = 12.0;
constexpr auto turn_radpm = 0.25;

/// What rounding, noise and clocks explain.
constexpr auto place_m = 1.5;
constexpr auto speed_mps = 1.5;
constexpr auto turn_rad = 0.25;

/// A new place is believed after so many words that agree, and so long.
constexpr auto words_that_agree = 3;
constexpr duration time_that_agrees = 500ms;

} // namespace

world::perceived_object moved_on(world::perceived_object x, double dt_s) {
  const auto way_m = x.speed_mps * dt_s;
  if (way_m == 0)
    return x;
  x.centre = x.centre
             + way_m * point{std::cos(x.heading_rad), std::sin(x.heading_rad)};
  return x;
}

double unexplained_m(const timed_body& before, const timed_body& after) {
  const auto dt = after.at - before.at;
  assert(dt >= duration{});
  if (dt > longest_gap)
    return 0;
  const auto dt_s = to_seconds(dt);
  const auto& a = before.what;
  const auto& b = after.what;
  // The mean of where the old velocity leads and where the new one comes from.
  const auto off = 0.5
                   * (b.centre - moved_on(a, dt_s).centre
                      + moved_on(b, -dt_s).centre - a.centre);
  const auto fastest_mps =
      std::max(std::abs(a.speed_mps), std::abs(b.speed_mps));
  const auto place_limit_m =
      place_m + 0.1 * fastest_mps * dt_s + grip_mps2 / 4 * dt_s * dt_s;
  assert(!(place_limit_m < place_m));
  const auto too_far_m = std::sqrt(dot(off, off)) - place_limit_m;
  const auto too_fast_mps =
      std::abs(b.speed_mps - a.speed_mps) - speed_mps - grip_mps2 * dt_s;
  const auto too_turned_rad =
      std::abs(wrap_angle(b.heading_rad - a.heading_rad)) - turn_rad
      - turn_radpm * fastest_mps * dt_s;
  const auto way_m = fastest_mps * std::max(dt_s, 0.1);
  return std::max({0.0, too_far_m, too_fast_mps * std::max(dt_s, 0.1),
                   too_turned_rad * way_m});
}

double steady_word::check(const timed_body& word) {
  const auto is_old = [&](const std::optional<timed_body>& x) {
    return !x || word.at - x->at > longest_gap;
  };
  if (believed_ && word.at <= believed_->at) // overtaken on its way
    return unexplained_m(word, *believed_);
  assert(off_m_ >= 0);
  if (!is_old(believed_))
    off_m_ = unexplained_m(*believed_, word);
  else if (is_old(rival_))
    off_m_ = 0; // it begins anew
  assert(off_m_ >= 0 && (off_m_ == 0 || believed_ || rival_));
  if (off_m_ > 0 && !agrees(word))
    return off_m_;
  believed_ = word;
  rival_.reset();
  off_m_ = 0;
  return 0;
}

/// @returns whether enough words agree with each other, this one included.
bool steady_word::agrees(const timed_body& word) {
  if (!rival_ || word.at <= rival_->at || unexplained_m(*rival_, word) > 0) {
    rivals_ = 0;
    rival_since_ = word.at;
  }
  rival_ = word;
  assert(rivals_ >= 0 && rival_since_ <= word.at);
  return ++rivals_ >= words_that_agree
         && word.at - rival_since_ >= time_that_agrees;
}

} // namespace sofof::planners
