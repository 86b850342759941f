// What vehicles and whoever plans for them say to each other, and what each
// understands.
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/trajectory/lane_follow.hpp"
#include "tests/messages/v2x_sender.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/near.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

const session_id running{11, 101, "trajectory_planning", 7};

route_ptr round() {
  static const auto map = toy::grid(2, 100);
  static const auto way = toy::make_route(map, {0, 1, 3, 2}, true);
  return way;
}

/// A plan that speeds up from here.
trajectory plan_from(double s_m, double speed_mps, time_point t = start) {
  lane_follow planner{round(), {}};
  planning_input from;
  from.at = t;
  from.s_m = s_m;
  from.speed_mps = speed_mps;
  trajectory plan;
  planner.plan(t, from, nullptr, plan);
  REQUIRE(plan.is_sound());
  return plan;
}

cam at(double s_m, double speed_mps, time_point t = start) {
  const auto p = round()->path().at(s_m);
  return {101, t, p.at, p.heading_rad, speed_mps, 0, p.curvature_1pm};
}

/// Over the air: as bytes.
etsi::mcm sent(const etsi::mcm& message) {
  etsi::mcm got;
  REQUIRE(etsi::decode(encoded(message).view(), got));
  return got;
}

void check_same_drive(const trajectory& is, const trajectory& was) {
  REQUIRE(is.is_sound());
  CHECK(is.start >= was.start);
  CHECK(is.start < was.start + 1ms);
  CHECK(is.end() <= was.end() + 1ms);
  CHECK(is.end() > was.end() - 250ms);
  for (auto t = is.start; t < std::min(is.end(), was.end()); t += 50ms) {
    const auto a = is.at(t), b = was.at(t);
    CHECK(distance_m(a.at, b.at) < 0.03);
    CHECK(std::abs(a.speed_mps - b.speed_mps) < 0.05);
    CHECK(std::abs(a.s_m - b.s_m) < 0.03);
  }
}

const suggestion to_101{9001, {50, 50}, 101, {7, 3}};

std::shared_ptr<trajectory> plan_in(const etsi::mcm& message, double s_guess_m,
                                    time_point now = start + 20ms) {
  auto out = std::make_shared<trajectory>();
  const auto fault = read_suggestion(sent(message), 101, *round(), s_guess_m,
                                     *in_ulm(), now, nullptr, *out);
  REQUIRE(fault);
  REQUIRE(to_string(*fault) == to_string(maneuver_fault::none));
  return out;
}

} // namespace

// -- up ----------------------------------------------------------------------

TEST_CASE("a word tells the way ahead to a centimetre") {
  dice d{1};
  for (auto i = 0; i < 200; ++i) {
    const auto s_m = d.between(0, round()->length_m());
    const auto t =
        start + std::chrono::milliseconds{std::lround(d.between(0, 1e7))};
    const auto way = round()->waypoints(s_m, 200, 10);
    const auto own = at(s_m, 8, t);
    const auto got =
        read_word(sent(make_word({own, way, nullptr, {}}, car, *in_ulm())),
                  *in_ulm(), t + 40ms);
    REQUIRE(got);
    CHECK(got->from == 101);
    CHECK(got->at == t);
    CHECK(!got->plan);
    CHECK(!got->answer);
    REQUIRE(got->way.size() == way.size());
    for (std::size_t k = 0; k < way.size(); ++k)
      CHECK(distance_m(got->way[k], way[k]) < 0.0072);
  }
}

TEST_CASE("a word says how fast and how large the road user is") {
  const auto way = round()->waypoints(5, 50, 10);
  const auto message =
      sent(make_word({at(5, 8.123), way, nullptr, {}}, car, *in_ulm()));
  const auto& user = std::get<etsi::road_user_container>(
      message.body.parameters.maneuver.value);
  CHECK(user.state.speed.value == 812);
  CHECK(user.state.length == 51);
  CHECK(user.state.width == 19);
  const auto front = in_ulm()->frame.to_map(
      {message.body.parameters.basic.position.latitude,
       message.body.parameters.basic.position.longitude});
  REQUIRE(front);
  CHECK(distance_m(*front, front_of(at(5, 8), car)) < 0.007);
}

TEST_CASE("a word carries the plan in use for who takes over") {
  for (const auto s_m : {10.0, 60.0, 85.0}) {
    CAPTURE(s_m);
    const auto plan = plan_from(s_m, 5);
    const auto way = round()->waypoints(s_m, 200, 10);
    const auto message =
        make_word({at(s_m, 5), way, &plan, {}}, car, *in_ulm());
    const auto got = read_word(sent(message), *in_ulm(), start + 20ms);
    REQUIRE(got);
    REQUIRE(got->plan);
    trajectory again;
    const auto fault =
        to_trajectory(*got->plan, {in_ulm()->frame, got->reference, got->at},
                      *round(), s_m, nullptr, again);
    REQUIRE(to_string(fault) == to_string(maneuver_fault::none));
    check_same_drive(again, plan);
  }
}

TEST_CASE("a word tells the size of a body, unless it is larger than 6.1 m") {
  const auto way = round()->waypoints(12, 200, 10);
  const auto told = [&](double front_m) {
    auto body = car;
    body.front_m = front_m;
    const auto got = read_word(
        sent(make_word({at(12, 5), way, nullptr, {}}, body, *in_ulm())),
        *in_ulm(), start + 20ms);
    REQUIRE(got);
    CHECK(got->width_m.value() == doctest::Approx(car.width_m).epsilon(0.03));
    return got->length_m;
  };
  CHECK(told(car.front_m).value()
        == doctest::Approx(car.front_m + car.rear_m).epsilon(0.01));
  CHECK_FALSE(told(11));
}

TEST_CASE("of a plan that began before the word the rest is told") {
  const auto way = round()->waypoints(12, 200, 10);
  for (const auto age : {1ms, 50ms, 400ms, 433ms}) {
    CAPTURE(age.count());
    const auto plan = plan_from(10, 5, start - age);
    const auto got =
        read_word(sent(make_word({at(12, 5), way, &plan, {}}, car, *in_ulm())),
                  *in_ulm(), start + 20ms);
    REQUIRE(got);
    REQUIRE(got->plan);
    trajectory again;
    REQUIRE(to_trajectory(*got->plan,
                          {in_ulm()->frame, got->reference, got->at}, *round(),
                          12, nullptr, again)
            == maneuver_fault::none);
    CHECK(again.start >= start);
    CHECK(again.start < start + 1ms);
    for (auto t = start; t < again.end(); t += 100ms)
      CHECK(distance_m(again.at(t).at, plan.at(t).at) < 0.05);
    CHECK(again.end() > plan.end() - 500ms);
  }
}

TEST_CASE("a plan that is over is not told") {
  const auto plan = plan_from(10, 5, start - 1min);
  const auto way = round()->waypoints(12, 200, 10);
  const auto got =
      read_word(sent(make_word({at(12, 5), way, &plan, {}}, car, *in_ulm())),
                *in_ulm(), start + 20ms);
  REQUIRE(got);
  CHECK(!got->plan);
}

TEST_CASE("an answer names the suggestion that it answers") {
  for (const auto followed :
       {etsi::maneuver_response::accept, etsi::maneuver_response::reject}) {
    const auto way = round()->waypoints(5, 50, 10);
    mcm_uplink word{at(5, 8), way, nullptr, {}};
    word.answer.emplace(maneuver_name{65535, 12}, followed);
    const auto got =
        read_word(sent(make_word(word, car, *in_ulm())), *in_ulm(), start);
    REQUIRE(got);
    REQUIRE(got->answer);
    CHECK(got->answer->first.maneuver == 65535);
    CHECK(got->answer->first.update == 12);
    CHECK(got->answer->second == followed);
  }
}

TEST_CASE("who has nowhere to go, says nothing of its way") {
  mcm_uplink word{at(5, 8), {}, nullptr, {}};
  word.answer.emplace(maneuver_name{7, 0}, etsi::maneuver_response::reject);
  const auto got =
      read_word(sent(make_word(word, car, *in_ulm())), *in_ulm(), start);
  REQUIRE(got);
  CHECK(got->way.empty());
}

TEST_CASE("a word of one who does not say where it is is none") {
  const auto way = round()->waypoints(5, 50, 10);
  auto message = make_word({at(5, 8), way, nullptr, {}}, car, *in_ulm());
  message.body.parameters.basic.position.latitude =
      geo_position::unavailable_latitude;
  CHECK(!read_word(sent(message), *in_ulm(), start));
}

// -- down --------------------------------------------------------------------

TEST_CASE("a suggested plan is the plan again") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  for (const auto s_m : {10.0, 60.0, 85.0, 390.0})
    for (const auto speed : {0.0, 5.0, 9.5}) {
      CAPTURE(s_m);
      CAPTURE(speed);
      const auto plan = plan_from(s_m, speed);
      REQUIRE(make_suggestion(to_101, plan, *in_ulm(), room, message));
      check_same_drive(*plan_in(message, s_m), plan);
    }
}

TEST_CASE("a suggestion says whose it is and for whom") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  REQUIRE(make_suggestion(to_101, plan_from(10, 5), *in_ulm(), room, message));
  const auto got = sent(message);
  CHECK(got.header.station == 9001);
  const auto& to = std::get<etsi::suggested_maneuver_container>(
      got.body.parameters.maneuver.value);
  CHECK(to.target == 101);
  REQUIRE(to.maneuver);
  CHECK(to.maneuver->maneuver_id == 7);
  CHECK(to.maneuver->advice_update_id == 3);
  REQUIRE(to.maneuver->participants.size() == 1);
  CHECK(to.maneuver->participants[0] == 101);
  CHECK(got.body.parameters.basic.station_type == etsi::roadside_unit);
}

TEST_CASE("a suggestion from however far away still fits") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  const auto plan = plan_from(60, 8);
  for (const point far : {point{50, 1200}, point{50, 1500}, point{-3000, 50},
                          point{20000, 20000}}) {
    CAPTURE(far.x_m);
    CAPTURE(far.y_m);
    auto what = to_101;
    what.position = far;
    REQUIRE(make_suggestion(what, plan, *in_ulm(), room, message));
    check_same_drive(*plan_in(message, 60), plan);
  }
}

TEST_CASE("a plan that nobody can follow cannot be suggested") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  auto plan = plan_from(60, 8);
  plan.points[3].at.x_m = std::nan("");
  CHECK(!make_suggestion(to_101, plan, *in_ulm(), room, message));
}

TEST_CASE("a suggestion may come before or after the times wrap around") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  dice d{2};
  for (auto i = 0; i < 100; ++i) {
    const auto t =
        start + std::chrono::milliseconds{std::lround(d.between(0, 1e7))};
    const auto plan = plan_from(60, 8, t);
    REQUIRE(make_suggestion(to_101, plan, *in_ulm(), room, message));
    const auto got = plan_in(message, 60, t + 45ms);
    CHECK(got->start == t);
  }
}

TEST_CASE("a suggestion that says more or less than when to be where is no "
          "plan") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  REQUIRE(make_suggestion(to_101, plan_from(10, 5), *in_ulm(), room, message));
  auto& plan = std::get<etsi::maneuver_constraints>(
      std::get<etsi::suggested_maneuver_container>(
          message.body.parameters.maneuver.value)
          .maneuver->parameters.value);
  auto& x = plan.waypoints[1];
  SUBCASE("without a speed") {
    x.min_velocity.reset();
  }
  SUBCASE("with a range of speeds") {
    x.max_velocity->value = x.min_velocity->value + 1;
  }
  SUBCASE("with a range of times") {
    x.max_arrival_time.value = x.min_arrival_time.value + 1;
  }
  SUBCASE("with a stop") {
    x.min_duration_of_stop.emplace();
  }
  SUBCASE("with a corridor") {
    plan.corridor.emplace().push_back({});
  }
  trajectory out;
  const auto fault = read_suggestion(sent(message), 101, *round(), 10,
                                     *in_ulm(), start, nullptr, out);
  REQUIRE(fault);
  CHECK(*fault == maneuver_fault::not_understood);
}

TEST_CASE("a suggestion for elsewhere is no plan here") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  auto plan = plan_from(10, 5);
  for (auto& p : plan.points)
    p.at.y_m += 40;
  REQUIRE(make_suggestion(to_101, plan, *in_ulm(), room, message));
  trajectory out;
  const auto fault = read_suggestion(sent(message), 101, *round(), 10,
                                     *in_ulm(), start, nullptr, out);
  REQUIRE(fault);
  CHECK(*fault == maneuver_fault::off_route);
}

TEST_CASE("what is suggested to another station is nothing to this one") {
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  REQUIRE(make_suggestion(to_101, plan_from(10, 5), *in_ulm(), room, message));
  trajectory out;
  CHECK(!read_suggestion(sent(message), 102, *round(), 10, *in_ulm(), start,
                         nullptr, out));
}

TEST_CASE("a termination says why, and suggests nothing") {
  for (const auto why : {etsi::termination_status::regular_end,
                         etsi::termination_status::abort_by_timeout}) {
    const auto got = sent(make_termination(to_101, start, why, *in_ulm()));
    const auto& to = std::get<etsi::suggested_maneuver_container>(
        got.body.parameters.maneuver.value);
    CHECK(to.target == 101);
    REQUIRE(to.maneuver);
    CHECK(to.maneuver->maneuver_id == 7);
    CHECK(std::get<etsi::termination_status>(to.maneuver->parameters.value)
          == why);
    trajectory out;
    CHECK(!read_suggestion(got, 101, *round(), 10, *in_ulm(), start, nullptr,
                           out));
  }
}

TEST_CASE("a word suggests nothing, and a suggestion is no word") {
  const auto way = round()->waypoints(5, 50, 10);
  const auto word =
      sent(make_word({at(5, 8), way, nullptr, {}}, car, *in_ulm()));
  trajectory out;
  CHECK(
      !read_suggestion(word, 101, *round(), 5, *in_ulm(), start, nullptr, out));
  std::vector<maneuver_waypoint> room;
  etsi::mcm message;
  REQUIRE(make_suggestion(to_101, plan_from(10, 5), *in_ulm(), room, message));
  CHECK(!read_word(sent(message), *in_ulm(), start));
}
