// Planning at a provider, from CAMs and MCMs alone.
#include "messages/v2x/mcm/mcm_content.hpp"
#include "tests/actors/planning_world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;

namespace {

const vehicle_params car;

/// A provider that has heard a vehicle and its word.
struct informed : planning {
  explicit informed(const std::string& way, double s_m = 20, double mps = 8)
      : planning{true}, ask{at(way, s_m, mps)} {
    meet(ask.own);
  }

  std::shared_ptr<const trajectory> plan() {
    const auto made = understood(run(word(ask)), ask);
    REQUIRE(made);
    return made;
  }

  plan_request ask;
};

etsi::suggested_maneuver_container
suggested(const offloading::service_output& result) {
  const auto pdu = result.what.as<its_pdu>();
  REQUIRE(pdu);
  const auto message = message_in<etsi::mcm>(*pdu);
  REQUIRE(message);
  CHECK(message->header.station == planning::provider);
  return std::get<etsi::suggested_maneuver_container>(
      message->body.parameters.maneuver.value);
}

/// Where a vehicle is that follows a plan to the letter.
cam on_plan(const trajectory& plan, time_point t) {
  const auto p = plan.at(t);
  return {planning::station, t, p.at, p.heading_rad, p.speed_mps, p.accel_mps2,
          p.curvature_1pm};
}

} // namespace

TEST_CASE("before a provider has heard a CAM and a word, it plans nothing") {
  planning there{true};
  const auto ask = there.at("3-4-5", 20, 8);
  CHECK(there.run({}).what.type().empty());
  CHECK(there.run(there.word(ask)).what.type().empty());
  there.meet(ask.own);
  CHECK(there.understood(there.run({}), ask)); // the word is remembered

  planning other{true};
  other.meet(ask.own);
  CHECK(other.run({}).what.type().empty());
  CHECK(other.understood(other.run(other.word(ask)), ask));
}

TEST_CASE("a provider suggests nothing before it has heard a vehicle for long "
          "enough, without a gap, to know what is round it") {
  planning there{true};
  const auto hears = [&](time_point t) {
    *there.now = t;
    const auto ask = there.at("3-4-5", 20, 0);
    there.hear(pdu_of(ask.own));
    return there.understood(there.run(there.word(ask)), ask) != nullptr;
  };
  CHECK_FALSE(hears(planning::start));
  CHECK_FALSE(hears(planning::start + 500ms));
  CHECK_FALSE(hears(planning::start + 2s)); // it was silent for too long
  CHECK(hears(planning::start + 3s));
  CHECK(hears(planning::start + 5s)); // once begun, it goes on
}

TEST_CASE("what a vehicle asks its own planner is no word") {
  planning there{true};
  const auto ask = there.at("3-4-5", 20, 8);
  there.hear(pdu_of(ask.own));
  CHECK(there.run(payload::of(ask)).what.type().empty());
}

TEST_CASE("a provider plans along the way that it is told, not one that "
          "begins alike") {
  for (const auto name : {"0-1-4-3", "0-1-2"}) {
    CAPTURE(name);
    informed there{name};
    const auto plan = there.plan();
    CHECK(plan->points.front().s_m == doctest::Approx(20).epsilon(0.001));
    const auto& path = there.way(name)->path();
    const auto end = plan->points.back();
    REQUIRE(end.s_m > 50);
    // Drive on, until the ways have parted.
    *there.now += 8s;
    there.ask = there.at(name, 100, 8);
    there.hear(pdu_of(there.ask.own));
    const auto later = there.plan();
    REQUIRE(later->points.back().s_m > 120);
    for (const auto& p : later->points)
      CHECK(std::abs(path.project(p.at, p.s_m, 5).d_m) < 1);
  }
}

TEST_CASE("who is allowed all the way does not stop") {
  informed there{"3-4-5", 20, 8};
  const auto plan = there.plan();
  CHECK(plan->points.back().speed_mps > 5);
}

TEST_CASE("a plan ends with the front where the authority ends") {
  for (const auto ahead_m : {30.0, 45.0, 60.0}) {
    CAPTURE(ahead_m);
    informed there{"3-4-5", 20, 8};
    there.ask.seen.stop_at_m = 20 + ahead_m;
    const auto plan = there.plan();
    for (const auto& p : plan->points)
      CHECK(p.s_m + car.front_m < 20 + ahead_m + 0.05);
    // It uses what it may use, if it gets that far.
    if (plan->points.back().speed_mps < 0.01)
      CHECK(plan->points.back().s_m + car.front_m > 20 + ahead_m - 5);
  }
}

TEST_CASE("when the authority grows, the plan goes on") {
  informed there{"3-4-5", 20, 8};
  there.ask.seen.stop_at_m = 50;
  CHECK(there.plan()->points.back().s_m < 50);
  *there.now += 100ms;
  there.ask = there.at("3-4-5", 20.8, 8);
  CHECK(there.plan()->points.back().s_m > 55);
}

TEST_CASE("a suggestion counts plans, names the running service, and says how "
          "it came about") {
  informed there{"3-4-5"};
  there.running.counter = 0x50007;
  there.running.station = planning::station;
  for (std::uint16_t k = 1; k <= 3; ++k) {
    const auto result = there.run(there.word(there.ask));
    CHECK(result.about.as<plan_report>());
    const auto to = suggested(result);
    CHECK(to.target == planning::station);
    REQUIRE(to.maneuver);
    CHECK(to.maneuver->maneuver_id == 7); // the last 16 bits
    CHECK(to.maneuver->advice_update_id == k);
    *there.now += 50ms;
  }
}

TEST_CASE("a provider takes the vehicle's plan over without a jump") {
  planning home{false};
  const auto began = home.at("3-4-5", 20, 5);
  const auto own_plan = home.ask(began);
  REQUIRE(own_plan);

  const auto jump = [&](bool tells_plan) {
    informed there{"3-4-5", 20, 5}; // of 1 s ago, when it began to speed up
    *there.now = planning::start + 1s;
    auto ask = there.at("3-4-5", own_plan->at(*there.now).s_m,
                        own_plan->at(*there.now).speed_mps);
    ask.own = on_plan(*own_plan, *there.now);
    // The plan in use is the newest: it has just been made.
    auto newest = *own_plan;
    *home.now = planning::start + 1s;
    auto again = home.at("3-4-5", ask.from.s_m, ask.from.speed_mps);
    again.from.accel_mps2 = own_plan->at(*home.now).accel_mps2;
    if (const auto next = home.ask(again, payload::of(newest)))
      newest = *next;
    *there.now += 70ms;
    const auto made = there.understood(
        there.run(there.word(ask, payload::of(newest), tells_plan)), ask);
    REQUIRE(made);
    const auto was = newest.at(made->start), is = made->points.front();
    return trajectory_point{0,
                            std::abs(is.s_m - was.s_m),
                            {},
                            0,
                            std::abs(is.curvature_1pm - was.curvature_1pm),
                            std::abs(is.speed_mps - was.speed_mps),
                            std::abs(is.accel_mps2 - was.accel_mps2)};
  };
  const auto smooth = jump(true);
  CHECK(smooth.s_m < 0.03);
  CHECK(smooth.speed_mps < 0.03);
  CHECK(smooth.accel_mps2 < 0.15);
  CHECK(smooth.curvature_1pm < 0.002);
  const auto rough = jump(false); // only a CAM of a second ago
  CHECK(rough.speed_mps > 3 * smooth.speed_mps);
}

TEST_CASE("a provider goes on planning with a CAM a second, or every two") {
  for (const auto steps : {20, 38}) {
    CAPTURE(steps);
    informed there{"0-1-4-3", 20, 3};
    std::shared_ptr<const trajectory> plan;
    auto s_m = 20.0;
    for (auto step = 0; step < 20 * 20; ++step, *there.now += 50ms) {
      CAPTURE(step);
      const auto t = *there.now;
      if (plan) {
        s_m = plan->at(t).s_m;
        if (step % steps == 0)
          there.hear(pdu_of(on_plan(*plan, t)));
      }
      if (step % 2 == 0) {
        there.ask = there.at("0-1-4-3", s_m, 3);
        if (plan)
          there.ask.own = on_plan(*plan, t);
      }
      const auto next = there.understood(there.run(there.word(there.ask)),
                                         there.ask, plan.get());
      REQUIRE(next);
      if (plan) {
        const auto was = plan->at(next->start), is = next->at(next->start);
        REQUIRE(distance_m(is.at, was.at) < 0.05);
        REQUIRE(std::abs(is.speed_mps - was.speed_mps) < 0.05);
        REQUIRE(std::abs(is.accel_mps2 - was.accel_mps2) < 0.3);
      }
      plan = next;
    }
    CHECK(s_m > 120); // and so it drives, round corners
  }
}

TEST_CASE("a provider knows without a CAM that a vehicle brakes as it was told "
          "to") {
  informed there{"3-4-5", 20, 8};
  std::shared_ptr<const trajectory> plan;
  auto s_m = 20.0;
  for (auto step = 0; step < 38; ++step, *there.now += 50ms) {
    CAPTURE(step);
    if (plan)
      s_m = plan->at(*there.now).s_m;
    there.ask = there.at("3-4-5", s_m, 8);
    there.ask.seen.stop_at_m = 45;
    if (plan)
      there.ask.own = on_plan(*plan, *there.now);
    const auto next = there.understood(there.run(there.word(there.ask)),
                                       there.ask, plan.get());
    REQUIRE(next);
    if (plan)
      REQUIRE(std::abs(next->at(next->start).speed_mps
                       - plan->at(next->start).speed_mps)
              < 0.05);
    plan = next;
  }
  CHECK(plan->points.front().speed_mps < 6);
}

TEST_CASE("a vehicle that does not follow is planned for from where it is") {
  informed there{"3-4-5", 20, 8};
  there.plan();
  *there.now += 1s;
  there.ask = there.at("3-4-5", 21, 0); // it has stopped at once
  there.hear(pdu_of(there.ask.own));
  const auto plan = there.plan();
  CHECK(plan->points.front().s_m == doctest::Approx(21).epsilon(0.005));
  CHECK(plan->points.front().speed_mps < 0.1);
}

TEST_CASE("a provider plans around what it is told by CPMs") {
  informed there{"3-4-5", 0, 8};
  const auto free_m = there.plan()->points.back().s_m;
  *there.now += 50ms;
  const auto at = there.way("3-4-5")->path().at(40).at;
  there.hear(pdu_of({102, *there.now, {0, 300}}, {{1, {at, 0, 0, 0, 5, 2}}}));
  CHECK(free_m > 45);
  CHECK(there.plan()->points.back().s_m < 40);
}
