// A vehicle that is advised at a crossing, claims, and hears others.
#include "planners/crossing/crossing_member.hpp"

#include "planners/crossing/agreed.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace sofof;
using namespace sofof::planners;
using namespace std::chrono_literals;
using state = claim_book::state;

namespace {

constexpr double speed_mps = 8, line_m = 100, clear_m = 120;
constexpr station_id own_car = 101, peer = 102;

time_point at(double t_s) {
  return time_point{from_seconds(t_s)};
}

/// Along the x axis (or across it, there where x is 110 m).
world::trajectory drive(double from_m, double t_s, double heading_rad = 0,
                        double v = speed_mps) {
  world::trajectory x;
  x.start = at(t_s);
  for (int k = 0; k <= 200; ++k) {
    const auto s = from_m + 0.1 * k * v;
    const auto place = heading_rad == 0 ? point{s, 0} : point{110, s - 110};
    x.points.push_back({0.1 * k, s, place, heading_rad, 0, v, 0});
  }
  return x;
}

crossing_member::place here(double s_m, double speed = speed_mps,
                            const world::trajectory* plan = nullptr) {
  return {s_m, speed, line_m, clear_m, {s_m, 0}, plan};
}

claimed_drive bodies(const world::trajectory& x) {
  claimed_drive all{x.start, 100ms, {}};
  for (const auto& p : x.points)
    all.bodies.push_back({p.at, p.heading_rad, 5, 2});
  return all;
}

/// It drives as it is advised, from 20 m at 0 s on.
struct advised_car {
  explicit advised_car(double claims_at_s) {
    for (auto t = 0.0; t <= claims_at_s; t += 0.05) {
      member.advise(at(t), way);
      member.move(at(t), here(20 + speed_mps * t, speed_mps, &way));
    }
  }
  crossing_member member{own_car, {}};
  world::trajectory way = drive(20, 0);
};

// Its front is at the line after (100 - 3.95 - 20) / 8 = 9.5 s, about.
constexpr double before_s = 4, after_s = 6;

} // namespace

TEST_CASE("a drive is claimed shortly before it enters the crossing") {
  advised_car car{before_s};
  CHECK(car.member.state() == state::free);
  REQUIRE(car.member.drive());
  CHECK_FALSE(car.member.tell(at(before_s)).drive);
  advised_car later{after_s};
  CHECK(later.member.state() != state::free);
  const auto told = later.member.tell(at(after_s));
  REQUIRE(told.drive);
  CHECK(told.drive->from > at(8.5)); // its way up to there is its own
  CHECK(told.drive->to() < at(14));
}

TEST_CASE("a claim binds when others have spoken since, and only then the car "
          "may pass the line") {
  advised_car car{before_s};
  car.member.on_report(at(before_s), {peer, at(before_s), {}}, {}, {100, 20});
  for (auto t = before_s; t < 9; t += 0.05) {
    car.member.advise(at(t), car.way);
    car.member.move(at(t), here(20 + speed_mps * t, speed_mps, &car.way));
    // So that the other one matters still, as if nothing new came of it.
    if (car.member.state() == state::claimed)
      break;
  }
  REQUIRE(car.member.state() == state::claimed);
  crossing_view view;
  car.member.look(at(5.2), view);
  CHECK_FALSE(view.binds);
  CHECK(waiting_line_m(view, {85, speed_mps, 3.95}));
  car.member.on_report(at(5.4), {peer, at(5.4), {}}, {}, {100, 20});
  car.member.look(at(5.4), view);
  CHECK(view.binds);
  CHECK_FALSE(waiting_line_m(view, {85, speed_mps, 3.95}));
}

TEST_CASE("what another one claims is not claimed") {
  advised_car car{before_s};
  const auto across = bodies(drive(20, 0, std::numbers::pi / 2));
  car.member.on_report(at(before_s), {peer, at(before_s), across}, across,
                       {110, -40});
  for (auto t = before_s; t < 8; t += 0.05) {
    car.member.advise(at(t), car.way);
    car.member.on_report(at(t), {peer, at(t), across}, across, {110, -40});
    car.member.move(at(t), here(20 + speed_mps * t, speed_mps, &car.way));
    CHECK(car.member.state() == state::free);
  }
}

TEST_CASE("two that are fast ask each other from farther away") {
  constexpr double fast_mps = 25;
  const auto along = drive(-100, 0, 0, fast_mps);
  const auto across = drive(-100, 0, std::numbers::pi / 2, fast_mps);
  crossing_member one{own_car, {}}, other{peer, {}};
  auto were_claimed = false;
  for (auto t = 0.0; t < 6; t += 0.1) {
    const auto s_m = -100 + fast_mps * t;
    const point on_x{s_m, 0}, on_y{110, s_m - 110};
    one.advise(at(t), along);
    other.advise(at(t), across);
    one.move(at(t), {s_m, fast_mps, line_m, clear_m, on_x, &along});
    other.move(at(t), {s_m, fast_mps, line_m, clear_m, on_y, &across});
    const auto told = one.tell(at(t)), answer = other.tell(at(t));
    were_claimed = were_claimed || (told.drive && answer.drive);
    one.on_report(at(t), answer, bodies(across), on_y);
    other.on_report(at(t), told, bodies(along), on_x);
    CHECK_FALSE((one.state() == state::bound && other.state() == state::bound));
  }
  CHECK(were_claimed);
}

TEST_CASE("who will not come when it said gives its claim up, unless it cannot "
          "stop any more") {
  advised_car car{after_s};
  REQUIRE(car.member.state() == state::bound);
  const auto s_m = 20 + speed_mps * after_s;
  const auto late = drive(s_m - 10, after_s); // 10 m less, so 1.25 s later
  car.member.end_advice();
  car.member.move(at(after_s), here(s_m - 10, speed_mps, &late));
  CHECK(car.member.state() == state::free);

  advised_car close{after_s};
  REQUIRE(close.member.state() == state::bound);
  const auto slow = drive(91, 9, 0, 4); // 0.8 s later at the line
  close.member.end_advice();
  close.member.move(at(9), here(91, speed_mps, &slow)); // 1 m behind its claim
  CHECK(close.member.state() == state::bound);
}

TEST_CASE("who is farther behind its claim than others allow for gives it up, "
          "wherever it is") {
  advised_car car{after_s};
  REQUIRE(car.member.state() == state::bound);
  car.member.end_advice();
  const auto slow = drive(89, 9); // 3 m behind
  car.member.move(at(9), here(89, speed_mps, &slow));
  CHECK(car.member.state() == state::free);
}

TEST_CASE("who is on the crossing before its claim says gives it up") {
  advised_car car{after_s};
  REQUIRE(car.member.state() == state::bound);
  car.member.end_advice();
  const auto fast = drive(107, 10);
  car.member.move(at(10), here(107, speed_mps, &fast)); // 7 m before it
  CHECK(car.member.state() == state::free);
}

TEST_CASE(
    "who brakes for its line, as its claim does not bind yet, gives it up "
    "when it will be late") {
  crossing_member member{own_car, {}};
  const auto way = drive(20, 0), stopping = drive(87.5, 8.5, 0, 0.01);
  member.on_report(at(8.2), {peer, at(8.2), {}}, {}, {115, 5});
  member.advise(at(8.25), way);
  member.move(at(8.25), here(86, speed_mps, &way));
  REQUIRE(member.state() == state::claimed);
  member.end_advice();
  member.move(at(8.5), here(87.5, 5, &stopping));
  CHECK(member.state() == state::free);
}

TEST_CASE("a drive that the own plan leaves behind on the crossing is not "
          "claimed") {
  crossing_member member{own_car, {}};
  auto way = drive(20, 0);
  for (auto& p : way.points) // as advised, it is half as fast there
    if (p.s_m > line_m) {
      p.s_m = (p.s_m + line_m) / 2;
      p.at.x_m = p.s_m;
      p.speed_mps /= 2;
    }
  const auto plan = drive(20 + speed_mps * after_s, after_s);
  member.advise(at(after_s), way);
  member.move(at(after_s), here(20 + speed_mps * after_s, speed_mps, &plan));
  CHECK(member.state() == state::free);
}

TEST_CASE("who is on the crossing claims no drive that begins behind it") {
  for (const auto behind_m : {1.0, 8.0}) {
    crossing_member member{own_car, {}};
    const auto way = drive(105 - behind_m, 12), plan = drive(105, 12);
    member.advise(at(12), way);
    member.move(at(12), here(105, speed_mps, &plan));
    CHECK((member.state() == state::free) == (behind_m > 2.4));
  }
}

TEST_CASE("who is held up on the crossing gives its claim up, and claims anew "
          "what it is advised from there") {
  advised_car car{after_s};
  REQUIRE(car.member.state() == state::bound);
  const auto stands = drive(97, 12);
  car.member.advise(at(12), stands);
  car.member.move(at(12), here(97, 0.2, &stands)); // 19 m behind its claim
  const auto past = car.member.take_past();
  REQUIRE(past);
  CHECK_FALSE(past->was_kept);
  CHECK(car.member.state() != state::free);
  CHECK(car.member.drive()->start == at(12));
}

TEST_CASE("a claim that is over is told once: kept, or given up before") {
  advised_car car{before_s};
  CHECK_FALSE(car.member.take_past());
  for (auto t = before_s; t < 14; t += 0.05) {
    car.member.advise(at(t), car.way);
    car.member.move(at(t), here(20 + speed_mps * t, speed_mps, &car.way));
  }
  const auto past = car.member.take_past();
  REQUIRE(past);
  CHECK(past->was_kept);
  CHECK(past->bound);
  CHECK(to_seconds(past->enters - at(9.5)) == doctest::Approx(0).epsilon(0.1));
  CHECK(past->leaves > past->enters);
  CHECK_FALSE(car.member.take_past());

  advised_car other{after_s};
  const auto s_m = 10 + speed_mps * after_s;
  const auto late = drive(s_m, after_s);
  other.member.move(at(after_s), here(s_m, speed_mps, &late));
  const auto given_up = other.member.take_past();
  REQUIRE(given_up);
  CHECK_FALSE(given_up->was_kept);
}

TEST_CASE("who is not advised any more goes by its own rules, but for what it "
          "has claimed") {
  advised_car car{before_s};
  car.member.move(at(before_s + 0.3), here(55, speed_mps, &car.way));
  CHECK(car.member.drive() == nullptr);
  advised_car later{after_s};
  later.member.move(at(after_s + 0.3), here(70, speed_mps, &later.way));
  CHECK(later.member.drive() != nullptr);
}

TEST_CASE("a drive that waits before the line is kept to up to there") {
  crossing_view view;
  view.line_m = line_m;
  view.drive.start = at(0);
  for (int k = 0; k <= 200; ++k) { // 20 m, 10 s at rest there, and on
    const auto s = k <= 50    ? 60 + 0.4 * k
                   : k <= 150 ? 80
                              : 80 + 0.4 * (k - 150);
    view.drive.points.push_back({0.1 * k, s, {s, 0}, 0, 0, 4, 0});
  }
  const auto before = agreed(view, at(2), {68, 4, 3.95});
  REQUIRE(before);
  REQUIRE(before->waits_at_m);
  CHECK(*before->waits_at_m == doctest::Approx(80).epsilon(0.01));
  CHECK(before->axle.empty());
  const auto after = agreed(view, at(15), {80, 0, 3.95});
  REQUIRE(after);
  CHECK_FALSE(after->waits_at_m);
  REQUIRE(!after->axle.empty());
  CHECK(after->binds_from_m == doctest::Approx(line_m - 3.95 - 2));
  CHECK_FALSE(agreed({}, at(0), {60, 4, 3.95}));
}
