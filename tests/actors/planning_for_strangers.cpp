// Trajectory planning for those that tell nonsense.
#include "tests/actors/planning_world.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/each_number.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;

namespace {

constexpr auto start = planning::start;

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

  std::int64_t any_between(std::int64_t low, std::int64_t high) {
    const auto share = dice_.uniform(++draws_);
    if (share < 0.2)
      return share < 0.1 ? low : high;
    const auto range = static_cast<double>(high) - static_cast<double>(low);
    return low + static_cast<std::int64_t>((share - 0.2) / 0.8 * range);
  }

  /// @returns one of 0..n-1.
  std::size_t any_index(std::size_t n) {
    return static_cast<std::size_t>(dice_.uniform(++draws_)
                                    * static_cast<double>(n));
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

trajectory lie(trajectory x, liar& who) {
  who.hurt(x.start);
  if (who.lies() && !x.empty()) {
    auto& p = x.points[x.points.size() / 2];
    who.hurt_all(p.t_s, p.s_m, p.at.x_m, p.at.y_m, p.heading_rad,
                 p.curvature_1pm, p.speed_mps, p.accel_mps2);
  }
  return x;
}

/// Puts anything that can be said into some numbers of a message.
template <class Message>
its_pdu lie(const its_pdu& truth, liar& who) {
  auto message = *message_in<Message>(truth);
  each_number(message.body, [&]<class N>(N& x) {
    if (who.lies(0.03))
      x.value =
          static_cast<typename N::number>(who.any_between(N::low, N::high));
  });
  return encoded(message);
}

/// Breaks octets.
its_pdu garble(its_pdu x, liar& who) {
  auto& octets = x.octets;
  if (who.lies(0.3))
    octets.resize(who.any_index(octets.size() + 4));
  const auto flips = who.any_index(6);
  for (std::size_t i = 0; i < flips && !octets.empty(); ++i)
    octets[who.any_index(octets.size())] =
        static_cast<std::byte>(who.any_index(256));
  return x;
}

/// Of octets that begin like a message of some kind, or not at all.
its_pdu noise(liar& who) {
  constexpr std::array<std::array<int, 2>, 4> kinds{
      {{2, 2}, {1, 14}, {2, 20}, {2, 14}}};
  its_pdu x;
  x.octets.resize(who.any_index(400));
  for (auto& octet : x.octets)
    octet = static_cast<std::byte>(who.any_index(256));
  if (x.octets.size() > 2 && who.lies(0.9)) {
    const auto kind = kinds[who.any_index(kinds.size())];
    x.octets[0] = static_cast<std::byte>(kind[0]);
    x.octets[1] = static_cast<std::byte>(kind[1]);
  }
  return x;
}

} // namespace

TEST_CASE("whatever a vehicle's planner is told, it gives a sound plan") {
  constexpr auto rounds = 100;
  std::uint64_t number = 0;
  for (const auto granted : {true, false})
    for (const auto round : {true, false}) {
      CAPTURE(granted);
      CAPTURE(round);
      planning planner{false, granted}, other{false, granted};
      liar who{++number};
      payload in_use;
      for (auto i = 0; i < rounds; ++i) {
        CAPTURE(i);
        *planner.now = *other.now = start + i * 50ms;
        auto truth = planner.at(round ? "0-1-4-3" : "3-4-5", 60 + 0.4 * i, 8);
        truth.seen.objects = {car_at({90, 1.75}), car_at({130, 98.25}),
                              car_at({98.25, 60})};
        const auto made = planner.ask(lie(truth, who), in_use);
        REQUIRE(made);
        CHECK(made->is_sound());
        CHECK(made->start == *planner.now);
        // Another one has planned a moment later, and tells of it.
        *other.now += 1ms;
        if (const auto given = other.ask(truth); given && who.lies(0.5))
          in_use = payload::of(lie(*given, who));
      }
    }
}

TEST_CASE("whatever a provider's planner is told, it gives a sound plan or "
          "none, and goes on as soon as it hears the truth") {
  constexpr auto rounds = 150;
  std::uint64_t number = 100;
  for (const auto granted : {true, false}) {
    planning planner{true, granted};
    liar who{++number};
    planner.meet(planner.at("0-1-4-3", 60, 8).own);
    auto plans = 0;
    const auto take = [&](const offloading::service_output& result,
                          const plan_request& truth) {
      if (result.what.type().empty())
        return;
      const auto made = planner.understood(result, truth);
      if (!made)
        return; // of one who is said to be elsewhere
      ++plans;
      REQUIRE(made->is_sound());
      REQUIRE(made->start <= *planner.now);
      REQUIRE(made->start > *planner.now - 1ms);
    };
    for (auto i = 0; i < rounds; ++i) {
      CAPTURE(i);
      *planner.now = start + i * 50ms;
      const auto truth = planner.at("0-1-4-3", 60 + 0.4 * i, 8);
      const auto plan = payload::of(
          trajectory{*planner.now,
                     {{0, truth.from.s_m, truth.own.position, 0, 0, 8, 0},
                      {1, truth.from.s_m + 8, truth.own.position + point{8, 0},
                       0, 0, 8, 0}}});
      const auto word = *planner.word(truth, plan, true).as<its_pdu>();
      const auto sees =
          pdu_of(truth.own, {{1, car_at({130, 98.25})}, {2, car_at({90, 5})}});
      planner.hear(pdu_of(truth.own));
      planner.hear(lie<etsi::cam>(pdu_of(truth.own), who));
      planner.hear(lie<etsi::tr103562::cpm>(sees, who));
      planner.hear(garble(pdu_of(truth.own), who));
      planner.hear(garble(sees, who));
      planner.hear(noise(who));
      take(planner.run(payload::of(lie<etsi::mcm>(word, who))), truth);
      take(planner.run(payload::of(garble(word, who))), truth);
      take(planner.run(payload::of(noise(who))), truth);
    }
    CHECK(plans > rounds / 2); // the others begin where the vehicle is not
    *planner.now += 1500ms;    // the lies were of the near future at most
    const auto truth = planner.at("3-4-5", 20, 8);
    planner.hear(pdu_of(truth.own));
    const auto made =
        planner.understood(planner.run(planner.word(truth)), truth);
    REQUIRE(made);
    CHECK(made->points.front().s_m == doctest::Approx(20).epsilon(0.01));
  }
}

TEST_CASE("for one who is nowhere there is a plan on a round with crossings") {
  planning planner{false, false};
  auto ask = planner.at("0-1-4-3", 0, 0);
  for (const auto s : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300,
                       std::numeric_limits<double>::infinity()}) {
    ask.from.s_m = s;
    const auto made = planner.ask(ask);
    REQUIRE(made);
    CHECK(made->is_sound());
  }
}

TEST_CASE("a vehicle that plans anew does not go on braking for nothing") {
  planning planner{false};
  auto ask = planner.at("3-4-5", 20, 8);
  ask.from.accel_mps2 = ask.own.accel_mps2 = -6.5;
  const auto made = planner.ask(ask);
  REQUIRE(made);
  CHECK(made->points.front().accel_mps2 == doctest::Approx(-2));
  CHECK(made->points.back().speed_mps > 5);
}

TEST_CASE("what nobody can have seen yet blinds no vehicle's planner") {
  planning planner{false};
  auto ask = planner.at("3-4-5", 0, 8);
  ask.seen.objects = {car_at(planner.way(ask.way)->path().at(40).at)};
  const auto stands_m = [&] {
    const auto made = planner.ask(ask);
    REQUIRE(made);
    return made->points.back().s_m;
  };
  CHECK(stands_m() < 40);
  auto dream = ask;
  dream.seen.objects.clear();
  dream.seen.at = start + 2s;
  planner.ask(dream);
  *planner.now = ask.from.at = ask.seen.at = start + 50ms;
  CHECK(stands_m() < 40);
}

TEST_CASE("what nobody can have seen yet blinds no provider's planner") {
  planning planner{true};
  const auto ask = planner.at("3-4-5", 0, 8);
  const auto obstacle = car_at(planner.way(ask.way)->path().at(40).at);
  const auto stands_m = [&] {
    const auto made = planner.understood(planner.run(planner.word(ask)), ask);
    REQUIRE(made);
    return made->points.back().s_m;
  };
  planner.meet(ask.own);
  const cam witness{102, start, {0, 300}, 0, 0};
  planner.hear(pdu_of(witness, {{1, obstacle}}));
  CHECK(stands_m() < 40);
  auto dreamer = witness;
  dreamer.at += 10s;
  planner.hear(pdu_of(dreamer));
  planner.hear(pdu_of(dreamer, {}));
  listener_of(*planner.there)->on_detections({start + 10s, {}});
  *planner.now = start + 50ms;
  planner.hear(pdu_of({102, start + 50ms, {0, 300}}, {{1, obstacle}}));
  CHECK(stands_m() < 40);
}

TEST_CASE("clocks may differ a little") {
  planning planner{true};
  const auto ask = planner.at("3-4-5", 0, 8);
  planner.meet(ask.own);
  planner.hear(pdu_of({102, start + 100ms, {0, 300}},
                      {{1, car_at(planner.way(ask.way)->path().at(40).at)}}));
  const auto made = planner.understood(planner.run(planner.word(ask)), ask);
  REQUIRE(made);
  CHECK(made->points.back().s_m < 40);
}

TEST_CASE("a word of another station does not steer this one's planning") {
  planning planner{true};
  const auto ask = planner.at("3-4-5", 0, 8);
  planner.meet(ask.own);
  auto other = ask;
  other.own.station = planning::station + 1;
  other.seen.stop_at_m = 30;
  CHECK(planner.run(planner.word(other)).what.type().empty());
  const auto free = planner.understood(planner.run(planner.word(ask)), ask);
  REQUIRE(free);
  CHECK(free->points.back().s_m > 50);
  *planner.now += 50ms;
  const auto still = planner.understood(planner.run(planner.word(other)), ask);
  REQUIRE(still);
  CHECK(still->points.back().s_m > 50);
}

TEST_CASE("a CAM of another station moves no one else") {
  planning planner{true};
  const auto ask = planner.at("3-4-5", 0, 8);
  planner.meet(ask.own);
  auto far = planner.at("3-4-5", 150, 8).own;
  far.station = planning::station + 1;
  far.at += 50ms;
  *planner.now += 50ms;
  planner.hear(pdu_of(far));
  const auto made = planner.understood(planner.run(planner.word(ask)), ask);
  REQUIRE(made);
  CHECK(made->points.front().s_m < 2);
}
