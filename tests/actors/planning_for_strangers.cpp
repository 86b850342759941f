// Trajectory planning for those that tell nonsense.
#include "actors/service_kind.hpp"
#include "actors/services/trajectory_planning.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace sofof;
using namespace std::chrono_literals;

namespace {

constexpr time_point start{100s};

/// A round and an open way over crossings.
streets_ptr blocks() {
  auto world = std::make_shared<streets>();
  world->map = toy::grid(3, 100);
  world->routes = {toy::make_route(world->map, {0, 1, 4, 3}, true),
                   toy::make_route(world->map, {3, 4, 5})};
  return world;
}

struct place {
  bool has_site, crossings_granted;
};

/// Plans on board or at a provider, at a time that a test sets.
struct planning {
  explicit planning(place where) {
    setup.station = 101;
    setup.remote = where.has_site;
    setup.crossings_granted = where.crossings_granted;
    setup.clock = [t = now] { return *t; };
    if (where.has_site)
      setup.site = kind->make_site(setup);
    function = kind->make_function(setup);
  }

  /// @returns what is planned now; null if nothing.
  std::shared_ptr<const drive_plan> run(const plan_request& ask,
                                        const payload& in_use = {}) {
    return function
        ->run(*now, {{}, *now, payload::of(plan_request{ask}), in_use})
        .as<drive_plan>();
  }

  std::shared_ptr<time_point> now = std::make_shared<time_point>(start);
  service_kind_ptr kind = make_service_kind("trajectory_planning");
  service_setup setup{.world = blocks()};
  std::shared_ptr<service_function> function;
};

perceived_object car_at(point centre) {
  return {centre, 0, 0, 0, 5, 2};
}

/// Says what is true, or what nobody can be, have or do.
class liar {
public:
  explicit liar(std::uint64_t number)
      : dice_{random_stream{7, "liar"}.part(number)} {}

  bool lies(double often = 0.15) { return dice_.uniform(++draws_) < often; }

  void hurt(double& x) {
    constexpr auto most = std::numeric_limits<double>::max();
    if (lies())
      x = any({nan, inf, -inf, most, -most, 1e300, -1e300, 1e19, -1e19, 1e7,
               -1e7, 1e3, -1e3, 1e-300, 0.0});
  }

  void hurt(float& x) {
    constexpr auto most = std::numeric_limits<float>::max();
    if (lies(0.01))
      x = static_cast<float>(
          any<double>({nan, inf, -inf, most, -most, 1e9, -1e9}));
  }

  void hurt(int& x) {
    constexpr auto most = std::numeric_limits<int>::max();
    if (lies())
      x = any({0, -1, 1, 2, 256, 257, 1000, most, -most});
  }

  void hurt(std::uint32_t& x) {
    if (lies())
      x = any({~0U, 1U << 31, 255U, 12345U});
  }

  void hurt(time_point& x) {
    if (lies())
      x = any({time_point{longest_time}, time_point{-longest_time},
               time_point{}, x + 1h, x - 1h, x + 1s, x - 400ms});
  }

  template <class... Ts>
  void hurt_all(Ts&... xs) {
    (hurt(xs), ...);
  }

private:
  static constexpr auto nan = std::numeric_limits<double>::quiet_NaN();
  static constexpr auto inf = std::numeric_limits<double>::infinity();

  template <class T>
  T any(std::initializer_list<T> all) {
    const auto share = dice_.uniform(++draws_);
    return all.begin()[static_cast<std::size_t>(
        share * static_cast<double>(all.size()))];
  }

  random_stream dice_;
  std::uint64_t draws_ = 0;
};

plan_request lie(plan_request x, liar& who) {
  auto& from = x.from;
  who.hurt_all(from.at, from.s_m, from.d_m, from.heading_error_rad,
               from.curvature_1pm, from.speed_mps, from.accel_mps2, x.seen.at);
  if (who.lies()) {
    x.seen.stop_at_m = from.s_m + 20;
    who.hurt(*x.seen.stop_at_m);
  }
  for (auto& o : x.seen.objects)
    who.hurt_all(o.centre.x_m, o.centre.y_m, o.heading_rad, o.speed_mps,
                 o.accel_mps2, o.length_m, o.width_m);
  if (who.lies(0.05))
    x.seen.objects.resize(300, car_at({60, -1.75}));
  return x;
}

template <std::size_t rows>
void lie(ocp::warm_start<rows>& x, liar& who) {
  who.hurt_all(x.ds_m, x.steps);
  if (who.lies(0.5))
    return;
  for (auto* column : {&x.x0, &x.x1, &x.x2, &x.u})
    who.hurt((*column)[7]);
  for (auto& column : x.force)
    who.hurt((column)[7]);
}

drive_plan lie(drive_plan x, liar& who) {
  who.hurt(x.plan.start);
  if (who.lies() && !x.plan.empty()) {
    auto& p = x.plan.points[x.plan.points.size() / 2];
    who.hurt_all(p.t_s, p.s_m, p.at.x_m, p.at.y_m, p.heading_rad,
                 p.curvature_1pm, p.speed_mps, p.accel_mps2);
  }
  if (x.memory) {
    auto memory = std::make_shared<planner_memory>(*x.memory);
    lie(memory->path, who);
    lie(memory->speed, who);
    who.hurt_all(memory->path_s_m, memory->speed_s_m, memory->sides,
                 memory->order);
    x.memory = memory;
  }
  return x;
}

constexpr std::array<place, 4> everywhere{
    {{false, true}, {false, false}, {true, true}, {true, false}}};

} // namespace

TEST_CASE("whatever a planner is told, it gives a sound plan") {
  constexpr auto rounds = 100;
  std::uint64_t number = 0;
  for (const auto& where : everywhere)
    for (const auto round : {true, false}) {
      CAPTURE(where.has_site);
      CAPTURE(where.crossings_granted);
      CAPTURE(round);
      planning planner{where}, other{where};
      liar who{++number};
      plan_request truth;
      truth.way = round ? "0-1-4-3" : "3-4-5";
      truth.from.speed_mps = 8;
      truth.seen.objects = {car_at({90, 1.75}), car_at({130, 98.25}),
                            car_at({98.25, 60})};
      payload in_use;
      for (auto i = 0; i < rounds; ++i) {
        CAPTURE(i);
        *planner.now = *other.now = truth.from.at = truth.seen.at =
            start + i * 50ms;
        truth.from.s_m = 60 + 0.4 * i;
        const auto made = planner.run(lie(truth, who), in_use);
        REQUIRE(made);
        CHECK(made->plan.is_sound());
        CHECK(made->plan.start == *planner.now);
        // Another one has planned a moment later, and tells of it.
        *other.now += 1ms;
        if (const auto given = other.run(truth); given && who.lies(0.5))
          in_use = payload::of(lie(*given, who));
      }
    }
}

TEST_CASE("for one who is nowhere there is a plan on a round with crossings") {
  planning planner{{false, false}};
  plan_request ask;
  ask.way = "0-1-4-3";
  ask.from.at = start;
  for (const auto s : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300,
                       std::numeric_limits<double>::infinity()}) {
    ask.from.s_m = s;
    const auto made = planner.run(ask);
    REQUIRE(made);
    CHECK(made->plan.is_sound());
  }
}

TEST_CASE("what nobody can have seen yet blinds no planner") {
  for (const auto has_site : {false, true}) {
    CAPTURE(has_site);
    planning planner{{has_site, true}};
    plan_request ask;
    ask.way = "3-4-5";
    ask.from.at = ask.seen.at = start;
    ask.from.speed_mps = 8;
    const auto way = planner.setup.world->find(ask.way);
    ask.seen.objects = {car_at(way->path().at(40).at)};
    const auto stands_m = [&] {
      const auto made = planner.run(ask);
      REQUIRE(made);
      return made->plan.points.back().s_m;
    };
    const auto before_m = stands_m();
    CHECK(before_m < 40);
    auto dream = ask;
    dream.seen.objects.clear();
    dream.seen.at = start + 2s;
    planner.run(dream);
    if (has_site) {
      planner.setup.site->see(start + 2s, {});
      planner.setup.site->hear(
          {.station = 7, .at = start + 2s, .position = {0, 500}});
    }
    *planner.now = ask.from.at = ask.seen.at = start + 50ms;
    CHECK(stands_m() < 40);
  }
}

TEST_CASE("clocks may differ a little") {
  planning planner{{true, true}};
  plan_request ask;
  ask.way = "3-4-5";
  ask.from.at = start;
  ask.from.speed_mps = 8;
  ask.seen.at = start + 100ms;
  const auto way = planner.setup.world->find(ask.way);
  ask.seen.objects = {car_at(way->path().at(40).at)};
  const auto made = planner.run(ask);
  REQUIRE(made);
  CHECK(made->plan.points.back().s_m < 40);
}
