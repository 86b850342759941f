// A drive as CommonRoad's kinematic single-track model has it.
#include "experiments/judge/ks_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace sofof::experiments::judge {

namespace {

/// Where the middle of a body is, which way it moves and how far it has.
struct middle_motion {
  point at;
  double heading_rad = 0, speed_mps = 0, way_m = 0;
};

/// A drive of middles, at any time.
class middle_drive {
public:
  explicit middle_drive(std::span<const driven_moment> drive)
      : step_s_{drive[1].t_s - drive[0].t_s} {
    const world::vehicle_params car;
    for (const auto& m : drive) {
      const auto& x = m.car;
      const auto side =
          axle_to_middle_m * std::tan(x.steer_rad) / car.wheelbase_m;
      const point ahead{std::cos(x.heading_rad), std::sin(x.heading_rad)};
      middle_motion next{x.at + axle_to_middle_m * ahead,
                         x.heading_rad + std::atan(side),
                         x.speed_mps * std::hypot(1, side), 0};
      if (!all_.empty()) {
        const auto& last = all_.back();
        next.heading_rad =
            last.heading_rad + wrap_angle(next.heading_rad - last.heading_rad);
        next.way_m =
            last.way_m + step_s_ * (last.speed_mps + next.speed_mps) / 2;
      }
      all_.push_back(next);
    }
  }

  double end_s() const {
    return step_s_ * static_cast<double>(all_.size() - 1);
  }

  /// At the ends as there.
  middle_motion at(double t_s) const {
    const auto steps = std::clamp(t_s, 0.0, end_s()) / step_s_;
    const auto i =
        std::min(static_cast<std::size_t>(steps + 1e-9), all_.size() - 2);
    const auto share = std::max(0.0, steps - static_cast<double>(i));
    const auto& a = all_[i];
    const auto& b = all_[i + 1];
    const auto mix = [share](auto x, auto y) { return x + share * (y - x); };
    return {a.at + share * (b.at - a.at), mix(a.heading_rad, b.heading_rad),
            mix(a.speed_mps, b.speed_mps), mix(a.way_m, b.way_m)};
  }

private:
  double step_s_;
  std::vector<middle_motion> all_;
};

/// Who hardly moves turns the wheel evenly to where it needs it next.
void turn_evenly(std::vector<ks_state>& states,
                 const std::vector<bool>& moves) {
  assert(states.size() == moves.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (moves[i])
      continue;
    auto next = i;
    while (next < states.size() && !moves[next])
      ++next;
    const auto from_rad = i > 0                  ? states[i - 1].steer_rad
                          : next < states.size() ? states[next].steer_rad
                                                 : 0;
    const auto to_rad =
        next < states.size() ? states[next].steer_rad : from_rad;
    const auto steps = static_cast<double>(next - i + 1);
    for (auto j = i; j < next; ++j)
      states[j].steer_rad =
          from_rad
          + (to_rad - from_rad) * static_cast<double>(j - i + 1) / steps;
    i = next;
  }
}

/// How far the model, driven evenly from one state, misses the next.
struct model_miss {
  double off_m = 0, turned_rad = 0;
};

model_miss miss(const ks_state& x, const ks_state& y, double step_s) {
  constexpr ks_vehicle car;
  constexpr auto parts = 10;
  const auto h_s = step_s / parts;
  auto at = x.at;
  auto heading_rad = x.heading_rad;
  for (auto k = 0; k < parts; ++k) {
    const auto share = (k + 0.5) / parts;
    const auto v = x.speed_mps + share * (y.speed_mps - x.speed_mps);
    const auto turn_rad =
        h_s * v / car.wheelbase_m
        * std::tan(x.steer_rad + share * (y.steer_rad - x.steer_rad));
    const auto course = heading_rad + turn_rad / 2;
    at = at + h_s * v * point{std::cos(course), std::sin(course)};
    heading_rad += turn_rad;
  }
  return {distance_m(at, y.at),
          std::abs(wrap_angle(heading_rad - y.heading_rad))};
}

} // namespace

oriented_box ks_state::body() const {
  constexpr ks_vehicle car;
  return {at, heading_rad, car.length_m, car.width_m};
}

std::vector<ks_state> ks_states(std::span<const driven_moment> drive,
                                double step_s, int first) {
  assert(drive.size() >= 2 && step_s > 0);
  constexpr ks_vehicle car;
  constexpr auto tolerance_s = 1e-6, least_way_m = 0.05;
  const middle_drive middles{drive};
  std::vector<ks_state> all;
  std::vector<bool> moves;
  for (auto k = 0; k * step_s <= middles.end_s() + tolerance_s; ++k) {
    const auto x = middles.at(k * step_s);
    const auto before = middles.at((k - 1) * step_s);
    const auto after = middles.at((k + 1) * step_s);
    const auto way_m = after.way_m - before.way_m;
    moves.push_back(way_m > least_way_m);
    const auto steer_rad =
        moves.back() ? std::atan(
            car.wheelbase_m * (after.heading_rad - before.heading_rad) / way_m)
                     : 0;
    all.push_back({first + k, x.at, steer_rad, x.speed_mps, x.heading_rad});
  }
  turn_evenly(all, moves);
  return all;
}

std::optional<std::string> broken_limit(std::span<const ks_state> states,
                                        double step_s) {
  constexpr ks_vehicle car;
  constexpr auto most_off_m = 0.01, most_turned_rad = 0.005;
  const auto too_much = [](int step, std::string_view what, double is,
                           double limit, std::string_view unit) {
    return fmt::format("{} of {:.2f} {} at step {}; the limit is {:.2f} {}.",
                       what, is, unit, step, limit, unit);
  };
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto& x = states[i];
    if (std::abs(x.steer_rad) > car.max_steer_rad)
      return too_much(x.step, "a steering angle", x.steer_rad,
                      car.max_steer_rad, "rad");
    if (x.speed_mps > car.max_speed_mps)
      return too_much(x.step, "a speed", x.speed_mps, car.max_speed_mps, "m/s");
    if (i + 1 == states.size())
      break;
    const auto& y = states[i + 1];
    const auto [off_m, turned_rad] = miss(x, y, step_s);
    if (off_m > most_off_m || turned_rad > most_turned_rad)
      return fmt::format("the model misses the next state of step {} by {:.3f} "
                         "m and {:.4f} rad.",
                         x.step, off_m, turned_rad);
    const auto rate_radps = (y.steer_rad - x.steer_rad) / step_s;
    if (std::abs(rate_radps) > car.max_steer_rate_radps)
      return too_much(x.step, "a steering rate", rate_radps,
                      car.max_steer_rate_radps, "rad/s");
    const auto accel_mps2 = (y.speed_mps - x.speed_mps) / step_s;
    const auto most_mps2 =
        car.max_accel_mps2
        * std::min(1.0, car.switch_mps / std::max(x.speed_mps, 0.1));
    if (accel_mps2 > most_mps2)
      return too_much(x.step, "an acceleration", accel_mps2, most_mps2, "m/s²");
    const auto aside_mps2 =
        x.speed_mps * x.speed_mps * std::tan(x.steer_rad) / car.wheelbase_m;
    if (const auto all_mps2 = std::hypot(accel_mps2, aside_mps2);
        all_mps2 > car.max_accel_mps2)
      return too_much(x.step, "an acceleration", all_mps2, car.max_accel_mps2,
                      "m/s²");
  }
  return std::nullopt;
}

} // namespace sofof::experiments::judge
