// Tests of the judge of tracks: what it refuses, after how long, what it adds,
// and what it must not refuse.
#include "planners/judges/track_judge.hpp"

#include "base/random.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

perceived_object told_car(double x_m, double y_m, double speed_mps = 0) {
  return {{x_m, y_m}, 0, speed_mps, 0, 5.1, 1.89};
}

using seen_bodies = std::vector<perceived_object>;

/// A vehicle that stands at the origin, looks round every 100 ms, and is told
/// of the others a moment later.
struct told_drive_of_tracks {
  time_point now{10s};
  double speed_mps = 0;
  duration link = 50ms; ///< From a look to what is told of it.
  seen_bodies seen;
  std::vector<std::pair<std::uint32_t, perceived_object>> told;
  double noise_m = 0;
  random_stream noise{1, "track_judge_test"};
  track_judge judge{sighting_noise{}, open_country()};
  std::size_t besides = 0; ///< After the last result.

  static std::shared_ptr<const line_of_sight> open_country() {
    return std::make_shared<const line_of_sight>();
  }

  track_verdict step() {
    auto look = seen;
    for (std::size_t k = 0; k < look.size(); ++k) {
      const auto draws = noise.part(k);
      const auto n = static_cast<std::uint64_t>(now.time_since_epoch().count());
      look[k].centre =
          look[k].centre
          + point{draws.normal(0, noise_m, n), draws.normal(0, noise_m, n, 1)};
    }
    seen_bodies what;
    std::vector<std::uint32_t> ids;
    for (const auto& [id, x] : told) {
      ids.push_back(id);
      what.push_back(moved_on(x, -to_seconds(link)));
    }
    const auto verdict = judge.judge(
        {now,
         now - link,
         what,
         ids,
         {now, {{0, 0}, 0, 100, 360}, speed_mps, now, look, {}, look.size()}});
    besides = judge.besides().size();
    now += 100ms;
    for (auto& x : seen)
      x = moved_on(x, 0.1);
    for (auto& x : told)
      x.second = moved_on(x.second, 0.1);
    return verdict;
  }

  /// Goes on for so long. @returns the check that refused, and when.
  std::optional<std::pair<std::string, double>>
  go_on(double for_s, const std::function<void()>& before = {}) {
    const auto begin = now;
    while (to_seconds(now - begin) < for_s) {
      if (before)
        before();
      if (const auto x = step().refused)
        return std::pair{std::string{x->check}, to_seconds(now - begin)};
    }
    return std::nullopt;
  }
};

} // namespace

TEST_CASE("what is told as it is seen is believed, with the sensor's noise") {
  told_drive_of_tracks x;
  x.noise_m = 0.1;
  x.seen = {told_car(20, 0, 8), told_car(-15, 3), told_car(40, -3.5, -8)};
  x.told = {{1, x.seen[0]}, {2, x.seen[1]}, {3, x.seen[2]}};
  CHECK_FALSE(x.go_on(5, [&] { CHECK(x.besides == 0); }));
}

TEST_CASE("a body that is seen and not told is added from the first result on, "
          "and refused after a second") {
  told_drive_of_tracks x;
  x.seen = {told_car(20, 0)};
  CHECK_FALSE(x.step().refused);
  CHECK(x.besides == 1);
  const auto end = x.go_on(3);
  REQUIRE(end);
  CHECK(end->first == "missing");
  CHECK(end->second < 1.6);
}

TEST_CASE("a body that has just come into sight is told a moment later") {
  told_drive_of_tracks x;
  CHECK_FALSE(x.go_on(2));
  x.seen = {told_car(30, 0)};
  CHECK_FALSE(x.step().refused);
  CHECK(x.besides == 0);
  x.told = {{1, x.seen[0]}};
  CHECK_FALSE(x.go_on(2));
  CHECK(x.judge.left_s() == 1);
}

TEST_CASE("a body far away is not missed") {
  told_drive_of_tracks x;
  x.seen = {told_car(50, 0)};
  CHECK_FALSE(x.go_on(3));
  SUBCASE("unless the vehicle cannot stop calmly before it") {
    x.speed_mps = 14;
    const auto end = x.go_on(3);
    REQUIRE(end);
    CHECK(end->first == "missing");
  }
}

TEST_CASE("a body that is told where the vehicle looks freely and sees none is "
          "refused") {
  told_drive_of_tracks x;
  x.told = {{1, told_car(15, 0)}};
  const auto end = x.go_on(3);
  REQUIRE(end);
  CHECK(end->first == "added");
  CHECK(end->second < 1.5);
}

TEST_CASE("a body that another one hides is believed") {
  told_drive_of_tracks x;
  x.seen = {told_car(10, 0)};
  x.told = {{1, told_car(10, 0)}, {2, told_car(18, 0)}};
  CHECK_FALSE(x.go_on(5));
}

TEST_CASE("a body that is told for a moment after it has gone is believed") {
  told_drive_of_tracks x;
  for (int k = 0; k < 5; ++k) {
    x.told = {{1, told_car(15, 0)}};
    CHECK_FALSE(x.go_on(0.6));
    x.told.clear();
    CHECK_FALSE(x.go_on(1.4));
  }
}

TEST_CASE("bodies that are told beside their places are added, and refused") {
  for (const auto by_m : {3.0, 1.0, 0.5}) {
    CAPTURE(by_m);
    told_drive_of_tracks x;
    x.noise_m = 0.1;
    x.seen = {told_car(20, 0)};
    x.told = {{1, told_car(20, by_m)}};
    const auto end = x.go_on(4);
    REQUIRE(end);
    CHECK(end->first == "shifted");
    CHECK(x.besides == 1);
  }
}

TEST_CASE("a body that is told beside its place is refused, whatever number it "
          "is told by") {
  told_drive_of_tracks x;
  x.seen = {told_car(12, -2.2), told_car(30, 4)};
  std::uint32_t number = 0;
  const auto lie = [&] {
    x.told = {{++number, told_car(12.9, -2.85)}, {++number, told_car(30, 4)}};
  };
  const auto end = x.go_on(4, lie);
  REQUIRE(end);
  CHECK(end->first == "shifted");
  CHECK(x.besides == 1);
}

TEST_CASE("a body that is told twice, and once where it is, is believed") {
  told_drive_of_tracks x;
  x.seen = {told_car(12, -2.2)};
  x.told = {{1, told_car(12.9, -2.85)}, {2, told_car(12, -2.2)}};
  CHECK_FALSE(x.go_on(4));
}

TEST_CASE("a body that is told to drive on while it stands is added, and "
          "refused") {
  told_drive_of_tracks x;
  x.seen = {told_car(20, 0)};
  const auto end = x.go_on(3, [&] { x.told = {{1, told_car(20, 0, 6)}}; });
  REQUIRE(end);
  CHECK(end->first == "shifted");
}

TEST_CASE("a body that is told smaller than it is is added, and refused") {
  told_drive_of_tracks x;
  x.seen = {told_car(20, 0)};
  auto small = told_car(20, 0);
  small.width_m = 0.5;
  x.told = {{1, small}};
  REQUIRE(x.go_on(3));
  CHECK(x.besides == 1);
}

TEST_CASE("a body that no road user is, or that jumps, is refused wherever it "
          "is") {
  told_drive_of_tracks x;
  SUBCASE("too fast") {
    x.told = {{1, told_car(-90, 50, 80)}};
    const auto end = x.go_on(3);
    REQUIRE(end);
    CHECK(end->first == "limits");
  }
  SUBCASE("too large") {
    x.told = {{1, told_car(90, 50)}};
    x.told[0].second.width_m = 20;
    const auto end = x.go_on(3);
    REQUIRE(end);
    CHECK(end->first == "limits");
  }
  SUBCASE("it jumps") {
    auto side_m = 50.0;
    const auto end = x.go_on(3, [&] {
      side_m = -side_m;
      x.told = {{1, told_car(90, side_m)}};
    });
    REQUIRE(end);
    CHECK(end->first == "jump");
  }
}

TEST_CASE("a body that jumps is refused, whatever number it is told by") {
  told_drive_of_tracks x;
  std::uint32_t number = 0;
  auto side_m = 20.0;
  const auto end = x.go_on(3, [&] {
    side_m = -side_m;
    x.told = {{++number, told_car(40, side_m)}};
  });
  REQUIRE(end);
  CHECK(end->first == "jump");
}

TEST_CASE("who is told by another number where it is, or comes as another one "
          "goes, is believed") {
  told_drive_of_tracks x;
  std::uint32_t number = 0;
  SUBCASE("where it is") {
    CHECK_FALSE(x.go_on(3, [&] {
      x.told = {{++number, told_car(40, 20, 0)}};
    }));
  }
  SUBCASE("one comes, one goes") {
    x.told = {{1, told_car(40, 20)}};
    CHECK_FALSE(x.go_on(1));
    x.told = {{2, told_car(40, -20)}};
    CHECK_FALSE(x.go_on(1));
  }
}

TEST_CASE("who changes from one lie to the next is refused as soon") {
  told_drive_of_tracks x;
  x.seen = {told_car(20, 3)};
  int k = 0;
  REQUIRE(x.go_on(2, [&] {
    x.told.clear();
    if (++k % 2 == 0)
      x.told = {{1, told_car(20, 3)}, {2, told_car(12, 0)}};
  }));
}

TEST_CASE("tracks of long ago are left out, and are no lie") {
  told_drive_of_tracks x;
  x.link = 600ms;
  const auto verdict = x.step();
  CHECK_FALSE(verdict.refused);
  REQUIRE(verdict.useless);
  CHECK(verdict.useless->check == "age");
}
