// What is told of a scene is never less cautious than the scene, nor by more
// than a unit of the message; and whatever comes, what is read can be planned
// with.
#include "actors/services/planning/scene_words.hpp"

#include "messages/v2x/scene/scene_message.hpp"
#include "planners/trajectory/maneuver_candidates.hpp"
#include "planners/trajectory/trajectory_planner.hpp"
#include "tests/actors/random_scene.hpp"
#include "tests/support/on_air.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::planners;
using namespace std::chrono_literals;
using messages::its_pdu;
using test::dice;
using test::told_by;

namespace {

constexpr auto infinity = std::numeric_limits<double>::infinity();
constexpr auto not_a_number = std::numeric_limits<double>::quiet_NaN();

/// What doubles may be off by.
constexpr double rounding = 1e-7;

its_pdu words_of(const driving_scene& scene, const scene_place& own) {
  return make_scene_words(scene, own, *test::in_ulm());
}

std::optional<decoded_scene> understood_of(const its_pdu& message,
                                           time_point now) {
  return read_scene_words(message, *test::in_ulm(), now);
}

/// @returns what is read of a scene, counted along the way as that one.
decoded_scene passed_on(const driving_scene& scene, const scene_place& own) {
  const auto message = words_of(scene, own);
  REQUIRE_FALSE(message.octets.empty());
  auto read = understood_of(message, own.at + 20ms);
  REQUIRE(read);
  move(read->scene, own.s_m);
  return *read;
}

/// Below by less than a unit, or the same.
bool is_below(double read, double said, double unit) {
  return read <= said + rounding && read > said - unit - rounding;
}
bool is_above(double read, double said, double unit) {
  return is_below(-read, -said, unit);
}

template <class Stretch>
bool is_wider(const Stretch& read, const Stretch& said, double unit) {
  return is_below(read.from_m, said.from_m, unit)
         && is_above(read.to_m, said.to_m, unit);
}

constexpr double cm = 0.01, mm = 0.001, hundredth_s = 0.01;

void check_crossing(const crossing_user& read, const crossing_user& said,
                    double late_s) {
  CHECK(is_wider(read, said, cm));
  const auto enter_s = said.enter_s + late_s, leave_s = said.leave_s + late_s;
  if (enter_s < 81.9) {
    CHECK(is_below(read.enter_s, enter_s, hundredth_s));
  } else {
    CHECK(read.enter_s <= enter_s);
    CHECK(read.enter_s > 81.9);
  }
  if (leave_s - enter_s < 163.8 && enter_s < 81.9)
    CHECK(is_above(read.leave_s, leave_s, hundredth_s));
  else
    CHECK(read.leave_s >= leave_s - rounding);
  CHECK(read.goes_first == said.goes_first);
  if (said.brakes_mps2 <= 6.2)
    CHECK(is_above(read.brakes_mps2, said.brakes_mps2, 0.1));
  else
    CHECK(read.brakes_mps2 == infinity);
  CHECK(read.body == said.body);
}

void check_lead(const driving_scene& read, const driving_scene& said,
                double late_s) {
  REQUIRE(read.lead.has_value() == said.lead.has_value());
  REQUIRE(read.lead_told.size() == said.lead_told.size());
  if (!said.lead)
    return;
  const auto &a = *read.lead, &b = *said.lead;
  CHECK(a.station == b.station);
  CHECK(is_below(a.rear_s_m, b.rear_s_m - late_s * b.speed_mps, cm));
  CHECK(is_below(a.speed_mps, b.speed_mps, cm));
  CHECK(is_below(a.accel_mps2, b.accel_mps2, cm));
  for (const auto later : {1ms, 100ms, 1000ms}) {
    const auto now = said.at + later;
    const auto x = moved_forward(a, read.at, now);
    const auto y = moved_forward(b, said.at, now);
    CHECK(x.rear_s_m <= y.rear_s_m + rounding);
    CHECK(x.speed_mps <= y.speed_mps + rounding);
  }
  for (std::size_t i = 0; i < said.lead_told.size(); ++i) {
    CHECK(is_below(read.lead_told[i].s_m, said.lead_told[i].s_m, cm));
    CHECK(is_above(read.lead_told[i].t_s, said.lead_told[i].t_s + late_s,
                   hundredth_s));
  }
}

void check_body(const lane_obstacle& read, const lane_obstacle& said,
                double late_s) {
  CHECK(is_below(read.low_m, said.low_m, mm));
  CHECK(is_above(read.high_m, said.high_m, mm));
  CHECK(std::abs(read.speed_mps - said.speed_mps) <= mm / 2 + rounding);
  // It is where the other one is as long as anybody plans.
  for (auto t = 0.0; t <= 9.9; t += 1.1) {
    const auto moved = said.speed_mps * t;
    const auto read_moved = read.speed_mps * (t + late_s);
    CHECK(read.from_m + read_moved <= said.from_m + moved + rounding);
    CHECK(read.to_m + read_moved >= said.to_m + moved - rounding);
  }
  auto here = said;
  here.from_m -= late_s * said.speed_mps;
  here.to_m -= late_s * said.speed_mps;
  CHECK(is_wider(read, here, said.speed_mps == 0 ? cm : 1.5 * cm));
  CHECK(is_below(read.left_m, said.left_m, mm));
  if (said.lacks_m == 0)
    CHECK(read.lacks_m == 0);
  else
    CHECK(is_above(read.lacks_m, said.lacks_m, 2 * mm));
}

/// Whom the car passes although room is lacking it does not stop for.
void check_passed(const lane_obstacle& read, const lane_obstacle& said) {
  if (said.lacks_m > 0 && said.left_m == 0)
    for (const auto side : {side_of_road::left, side_of_road::right})
      for (const auto half_m : {1.5, 1.75, 2.5})
        if (leaves_room(said, side, half_m))
          CHECK(leaves_room(read, side, half_m));
}

void check_sound(const decoded_scene& x) {
  const auto& scene = x.scene;
  const auto is_stretch = [](const auto& s) {
    return std::isfinite(s.from_m) && std::isfinite(s.to_m)
           && s.from_m <= s.to_m;
  };
  CHECK(scene.at == x.at);
  CHECK(x.seen <= x.at);
  CHECK(std::isfinite(x.position.x_m + x.position.y_m));
  CHECK_FALSE(scene.agreed);
  CHECK_FALSE(scene.stop_at_m);
  if (scene.lead) {
    CHECK(std::isfinite(scene.lead->rear_s_m));
    CHECK(std::isfinite(scene.lead->accel_mps2));
    CHECK(scene.lead->speed_mps >= 0);
  } else {
    CHECK(scene.lead_told.empty());
  }
  CHECK(std::ranges::is_sorted(scene.lead_told, {}, &way_moment::s_m));
  CHECK(std::ranges::is_sorted(scene.lead_told, {}, &way_moment::t_s));
  CHECK(std::ranges::is_sorted(scene.crossings, {}, &crossing_user::from_m));
  CHECK(std::ranges::is_sorted(scene.beside, {}, &lane_obstacle::from_m));
  CHECK(std::ranges::is_sorted(scene.yields_m));
  CHECK(std::ranges::is_sorted(scene.keep_free, {}, &way_stretch::from_m));
  for (const auto& c : scene.crossings)
    CHECK((is_stretch(c) && std::isfinite(c.enter_s) && c.enter_s <= c.leave_s
           && c.brakes_mps2 >= 0 && c.body > 0));
  for (const auto& b : scene.beside)
    CHECK((is_stretch(b) && b.lacks_m >= 0 && b.left_m >= 0
           && std::isfinite(b.low_m + b.high_m + b.speed_mps)));
  for (const auto s_m : scene.yields_m)
    CHECK(std::isfinite(s_m));
  CHECK(std::ranges::all_of(scene.keep_free, is_stretch));
  CHECK(scene.crossings.size() <= messages::scene::most_crossings);
  CHECK(scene.beside.size() <= messages::scene::most_bodies);
  CHECK(scene.yields_m.size() <= messages::scene::most_yields);
  CHECK(scene.keep_free.size() <= messages::scene::most_kept_free);
  CHECK(scene.lead_told.size() <= messages::scene::most_moments);
}

} // namespace

TEST_CASE("a scene that was told is never less cautious, nor by a unit more") {
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    CAPTURE(seed);
    const auto own = told_by(seed);
    const auto said = test::random_scene(seed, own);
    const auto got = passed_on(said, own);
    const auto& read = got.scene;
    check_sound(got);
    CHECK(got.from == own.station);
    const auto late_s = to_seconds(own.at - got.at);
    REQUIRE((late_s >= 0 && late_s < 0.001));
    CHECK(got.seen <= own.seen);
    CHECK(got.seen > own.seen - 2ms);
    CHECK(distance_m(got.position, own.position) < cm);
    CHECK(read.is_impatient == said.is_impatient);
    check_lead(read, said, late_s);
    REQUIRE(read.crossings.size() == said.crossings.size());
    for (std::size_t i = 0; i < said.crossings.size(); ++i)
      check_crossing(read.crossings[i], said.crossings[i], late_s);
    REQUIRE(read.beside.size() == said.beside.size());
    for (const auto& x : said.beside) { // known by where they reach to
      const auto it = std::ranges::find_if(read.beside, [&](const auto& y) {
        return is_below(y.low_m, x.low_m, mm)
               && is_above(y.high_m, x.high_m, mm);
      });
      REQUIRE(it != read.beside.end());
      check_body(*it, x, late_s);
      check_passed(*it, x);
    }
    REQUIRE(read.yields_m.size() == said.yields_m.size());
    for (std::size_t i = 0; i < said.yields_m.size(); ++i)
      CHECK(is_below(read.yields_m[i], said.yields_m[i], cm));
    REQUIRE(read.keep_free.size() == said.keep_free.size());
    for (std::size_t i = 0; i < said.keep_free.size(); ++i)
      CHECK(is_wider(read.keep_free[i], said.keep_free[i], cm));
  }
}

TEST_CASE("what was read is told on in the same octets") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    CAPTURE(seed);
    const auto own = told_by(seed);
    const auto message = words_of(test::random_scene(seed, own), own);
    const auto read = understood_of(message, own.at);
    REQUIRE(read);
    const auto again = words_of(
        read->scene, {own.station, 0, own.position, read->at, read->seen});
    CHECK(again.octets == message.octets);
  }
}

TEST_CASE("a scene of the future or of long ago does not hold") {
  const time_point now{100s};
  decoded_scene told;
  for (const auto& [age, does] : {std::pair{0ms, true},
                                  {1000ms, true},
                                  {1001ms, false},
                                  {-60000ms, false}}) {
    told.at = now - age;
    CHECK(holds(told, now) == does);
  }
}

TEST_CASE("what stays in the vehicle is not told") {
  const auto own = told_by(1);
  auto scene = test::random_scene(1, own);
  const auto message = words_of(scene, own);
  scene.stop_at_m = own.s_m + 30;
  scene.agreed = agreed_drive{{{own.s_m, 0}}, own.s_m, own.s_m + 10};
  CHECK(words_of(scene, own).octets == message.octets);
}

TEST_CASE("a scene with a number that is none is not told") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto own = told_by(seed);
    auto scene = test::random_scene(seed, own);
    REQUIRE_FALSE(words_of(scene, own).octets.empty());
    test::each_number_of(scene, [&](double& x) {
      const auto before = x;
      x = not_a_number;
      CHECK(words_of(scene, own).octets.empty());
      x = before;
    });
  }
  for (const auto nowhere : {not_a_number, infinity, 1e6}) {
    auto own = told_by(1);
    const auto scene = test::random_scene(1, own);
    own.position.x_m = nowhere;
    CHECK(words_of(scene, own).octets.empty());
  }
}

TEST_CASE("numbers out of range are not told, or more cautiously") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto own = told_by(seed);
    auto scene = test::random_scene(seed, own);
    test::each_number_of(scene, [&](double& x) {
      const auto before = x;
      for (const auto far : {-infinity, -1e9, 1e9, infinity}) {
        x = far;
        if (words_of(scene, own).octets.empty())
          continue;
        const auto got = passed_on(scene, own);
        check_sound(got);
        CHECK(far > 0); // too late, too hard, or too much room
        REQUIRE(got.scene.crossings.size() == scene.crossings.size());
        for (std::size_t i = 0; i < scene.crossings.size(); ++i) {
          const auto &a = got.scene.crossings[i], &b = scene.crossings[i];
          CHECK(a.enter_s <= b.enter_s + 0.001);
          CHECK(a.leave_s >= b.leave_s);
          CHECK(a.brakes_mps2 >= b.brakes_mps2 - rounding);
        }
      }
      x = before;
    });
  }
}

TEST_CASE("a scene of which something would be left out is not told") {
  const auto own = told_by(3);
  const auto is_told = [&](const auto& change) {
    driving_scene scene;
    scene.at = own.at;
    scene.lead = lead_vehicle{101, own.s_m + 20, 5, 0};
    change(scene);
    return !words_of(scene, own).octets.empty();
  };
  const auto at = [&](double m) { return own.s_m + m; };
  const crossing_user user{at(10), at(14), 1, 3, true, 2, 7};
  const lane_obstacle body{at(10), at(14), -2, -1};
  using namespace messages::scene;
  CHECK(is_told([](auto&) {}));
  for (const std::size_t over : {0, 1}) {
    CAPTURE(over);
    const auto fits = over == 0;
    CHECK(is_told(
              [&](auto& s) { s.crossings.assign(most_crossings + over, user); })
          == fits);
    CHECK(is_told([&](auto& s) {
            s.beside.assign(messages::scene::most_bodies + over, body);
          })
          == fits);
    CHECK(
        is_told([&](auto& s) { s.yields_m.assign(most_yields + over, at(9)); })
        == fits);
    CHECK(is_told([&](auto& s) {
            s.keep_free.assign(most_kept_free + over, {at(9), at(19)});
          })
          == fits);
    CHECK(is_told([&](auto& s) {
            s.lead_told.assign(most_moments + over, {at(30), 1});
          })
          == fits);
  }
}

TEST_CASE("a scene that is not in order is not told") {
  const auto own = told_by(4);
  const auto is_told = [&](const auto& change) {
    driving_scene scene;
    scene.at = own.at;
    change(scene);
    return !words_of(scene, own).octets.empty();
  };
  const auto at = [&](double m) { return own.s_m + m; };
  CHECK_FALSE(is_told([&](auto& s) {
    s.crossings = {{at(10), at(14), 1, 3, true, 2, 7},
                   {at(9), at(14), 1, 3, true, 2, 8}};
  }));
  CHECK_FALSE(is_told([&](auto& s) { s.yields_m = {at(10), at(9)}; }));
  CHECK_FALSE(is_told([&](auto& s) {
    s.keep_free = {{at(10), at(11)}, {at(9), at(11)}};
  }));
  CHECK_FALSE(is_told([&](auto& s) { s.keep_free = {{at(12), at(10)}}; }));
  CHECK_FALSE(is_told([&](auto& s) {
    s.crossings = {{at(10), at(14), 3, 1, true, 2, 7}};
  }));
  CHECK_FALSE(is_told([&](auto& s) {
    s.crossings = {{at(10), at(14), 1, 3, true, 2, 0}}; // nobody's
  }));
  CHECK_FALSE(is_told([&](auto& s) { s.lead_told = {{at(20), 1}}; }));
  CHECK_FALSE(is_told([&](auto& s) {
    s.lead = lead_vehicle{101, at(20), 5, 0};
    s.lead_told = {{at(30), 2}, {at(29), 3}};
  }));
  CHECK_FALSE(is_told([&](auto& s) {
    s.lead = lead_vehicle{101, at(20), 5, 0};
    s.lead_told = {{at(30), 2}, {at(31), 1}};
  }));
}

TEST_CASE("a scene of another moment than its place is not told") {
  const driving_scene nobody{.at = time_point{5s}};
  CHECK_FALSE(
      words_of(nobody, {7, 0, {}, nobody.at, nobody.at}).octets.empty());
  CHECK(
      words_of(nobody, {7, 0, {}, nobody.at + 1ms, nobody.at}).octets.empty());
  CHECK(
      words_of(nobody, {7, 0, {}, nobody.at, nobody.at + 1ms}).octets.empty());
  CHECK_FALSE(words_of(nobody, {7, 0, {}, nobody.at, nobody.at - 8191ms})
                  .octets.empty());
  CHECK(words_of(nobody, {7, 0, {}, nobody.at, nobody.at - 8192ms})
            .octets.empty());
}

TEST_CASE("a scene is read by the clock of who told it") {
  const driving_scene nobody{.at = time_point{5s}};
  auto message = words_of(nobody, {7, 0, {}, nobody.at, nobody.at - 40ms});
  message.ahead = 300ms;
  const auto read = understood_of(message, nobody.at);
  REQUIRE(read);
  CHECK(read->at == nobody.at - 300ms);
  CHECK(read->scene.at == read->at);
  CHECK(read->seen == read->at - 40ms);
}

TEST_CASE("a scene that was moved has moved as a whole") {
  const auto own = told_by(5);
  auto scene = test::random_scene(5, own);
  scene.stop_at_m = own.s_m + 30;
  scene.agreed = agreed_drive{{{own.s_m, 0}}, own.s_m, own.s_m + 10};
  auto moved = scene;
  move(moved, 8);
  CHECK(*moved.stop_at_m == *scene.stop_at_m + 8);
  CHECK(moved.agreed->axle[0].s_m == scene.agreed->axle[0].s_m + 8);
  CHECK(moved.agreed->binds_from_m == scene.agreed->binds_from_m + 8);
  CHECK(*moved.agreed->waits_at_m == *scene.agreed->waits_at_m + 8);
  auto there = own;
  there.s_m += 8;
  CHECK(words_of(moved, there).octets == words_of(scene, own).octets);
}

TEST_CASE("whatever octets come, they are refused or a sound scene") {
  dice random{7};
  const auto below = [&random](std::size_t n) {
    return static_cast<std::size_t>(random.between(0, static_cast<double>(n)));
  };
  int read = 0, refused = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    CAPTURE(i);
    const auto own = told_by(i / 20);
    static its_pdu whole;
    if (i % 20 == 0)
      whole = words_of(test::random_scene(i / 20, own), own);
    auto broken = whole;
    auto& octets = broken.octets;
    if (i % 20 == 19) { // nothing but its key is right
      octets.resize(2 + below(400));
      for (std::size_t k = 2; k < octets.size(); ++k)
        octets[k] = static_cast<std::byte>(below(256));
    } else if (i % 20 == 18) {
      octets.resize(below(octets.size()));
    } else {
      for (auto flips = 1 + below(4); flips > 0; --flips)
        octets[below(octets.size())] ^= std::byte{1} << below(8);
    }
    if (const auto got = understood_of(broken, own.at)) {
      ++read;
      check_sound(*got);
      // It is told on, or the message had something in another way.
      CHECK_FALSE(words_of(got->scene,
                           {got->from, 0, got->position, got->at, got->seen})
                      .octets.empty());
    } else {
      ++refused;
    }
  }
  CHECK(read > 10'000); // both happen, or nothing has been tested
  CHECK(refused > 10'000);
}
