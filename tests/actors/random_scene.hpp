// Scenes of any content that a scene message can tell.
#pragma once

#include "actors/services/planning/scene_words.hpp"
#include "tests/support/dice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace sofof::test {

/// @returns somewhere on a way, at any nanosecond.
inline actors::scene_place told_by(std::uint64_t seed) {
  dice random{seed ^ 0x5ce4e};
  actors::scene_place own;
  own.station = static_cast<std::uint32_t>(random.between(1, 4e9));
  own.s_m = random.between(0, 5000);
  own.position = {random.between(-3000, 3000), random.between(-3000, 3000)};
  own.at = time_point{from_seconds(random.between(0, 1000))};
  own.seen = own.at - from_seconds(random.between(0, 8));
  return own;
}

/// Makes scenes up; one for each seed.
class scene_maker {
public:
  scene_maker(std::uint64_t seed, const actors::scene_place& own)
      : random_{seed}, own_{own} {}

  planners::driving_scene make() {
    planners::driving_scene x;
    x.at = own_.at;
    x.is_impatient = happens(0.5);
    if (happens(0.7))
      make_lead(x);
    const auto by_from = [](auto& list) {
      std::ranges::sort(list, {}, [](const auto& s) { return s.from_m; });
    };
    for (auto n = some(63); n > 0; --n)
      x.crossings.push_back(crossing());
    for (auto n = some(31); n > 0; --n)
      x.beside.push_back(body());
    for (auto n = some(31); n > 0; --n)
      x.yields_m.push_back(at(-160, 490));
    for (auto n = some(31); n > 0; --n) {
      const auto [from_m, to_m] = stretch();
      x.keep_free.push_back({from_m, to_m});
    }
    by_from(x.crossings);
    by_from(x.beside);
    by_from(x.keep_free);
    std::ranges::sort(x.yields_m);
    return x;
  }

private:
  bool happens(double chance) { return random_.between(0, 1) < chance; }
  /// Mostly few.
  int some(int most) {
    return static_cast<int>(random_.between(0, happens(0.1) ? most + 1 : 5));
  }
  /// @returns any number, or one that is whole in a unit of the message.
  double number(double low, double high) {
    const auto x = random_.between(low, high);
    return happens(0.2) ? std::clamp(std::round(x * 100) / 100, low, high) : x;
  }
  double at(double low_m, double high_m) {
    return own_.s_m + number(low_m, high_m);
  }
  planners::way_stretch stretch() {
    const auto from_m = at(-160, 490);
    return {from_m, from_m + (happens(0.1) ? 0 : number(0, 600))};
  }

  void make_lead(planners::driving_scene& x) {
    auto& lead = x.lead.emplace();
    if (happens(0.5))
      lead.station = static_cast<std::uint32_t>(random_.between(0, 4e9));
    lead.rear_s_m = at(-150, 490);
    lead.speed_mps = happens(0.2) ? 0 : number(0, 60);
    lead.accel_mps2 = number(-12, 12);
    planners::way_moment next{lead.rear_s_m, happens(0.5) ? 0 : number(0, 9)};
    for (auto n = happens(0.5) ? some(256) : 0; n > 0; --n) {
      x.lead_told.push_back(next);
      next.s_m += number(0, 30);
      next.t_s += happens(0.8) ? 0.2 : number(0, 40);
    }
  }

  planners::crossing_user crossing() {
    constexpr auto never = std::numeric_limits<double>::infinity();
    const auto [from_m, to_m] = stretch();
    const auto enter_s = happens(0.05)  ? number(80, 500)
                         : happens(0.3) ? 0.0
                                        : number(-60, 60);
    const auto stays_s = happens(0.1)    ? never
                         : happens(0.05) ? number(100, 500)
                                         : number(0, 60);
    return {from_m,
            to_m,
            enter_s,
            enter_s + stays_s,
            happens(0.7),
            happens(0.2) ? never : number(0, 9),
            static_cast<std::uint32_t>(random_.between(1, 4e9))};
  }

  planners::lane_obstacle body() {
    const auto [from_m, to_m] = stretch();
    const auto low_m = number(-9, 9);
    return {from_m - 1,
            to_m,
            low_m,
            low_m + number(-0.5, 6),
            happens(0.5) ? 0 : number(-40, 40),
            happens(0.7) ? 0 : number(0, 2),
            happens(0.7) ? 0 : number(0, 9)};
  }

  dice random_;
  actors::scene_place own_;
};

inline planners::driving_scene random_scene(std::uint64_t seed,
                                            const actors::scene_place& own) {
  return scene_maker{seed, own}.make();
}

/// Calls `visit` with every number of a scene that is told.
void each_number_of(planners::driving_scene& scene, auto&& visit) {
  if (scene.lead) {
    visit(scene.lead->rear_s_m);
    visit(scene.lead->speed_mps);
    visit(scene.lead->accel_mps2);
  }
  for (auto& x : scene.lead_told) {
    visit(x.s_m);
    visit(x.t_s);
  }
  for (auto& x : scene.crossings) {
    visit(x.from_m);
    visit(x.to_m);
    visit(x.enter_s);
    visit(x.leave_s);
    visit(x.brakes_mps2);
  }
  for (auto& x : scene.beside) {
    visit(x.from_m);
    visit(x.to_m);
    visit(x.low_m);
    visit(x.high_m);
    visit(x.speed_mps);
    visit(x.lacks_m);
    visit(x.left_m);
  }
  for (auto& s_m : scene.yields_m)
    visit(s_m);
  for (auto& x : scene.keep_free) {
    visit(x.from_m);
    visit(x.to_m);
  }
}

} // namespace sofof::test
