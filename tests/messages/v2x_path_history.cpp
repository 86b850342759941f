// Where a vehicle has been, in few points.
#include "messages/v2x/path_history.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace std::chrono_literals;

namespace {

constexpr time_point departure{20s};

/// Drives along a line at 14 m/s, with a fix every 100 ms.
template <class Line>
std::vector<point> drive(path_history& history, double length_m, Line line) {
  std::vector<point> way;
  for (auto i = 0; 1.4 * i <= length_m; ++i) {
    way.push_back(line(1.4 * i));
    history.pass(departure + i * 100ms, way.back());
  }
  return way;
}

point straight_line(double s_m) {
  return {s_m, 0};
}

point winding(double s_m) {
  return {s_m, 6 * std::sin(s_m / 12)};
}

double length_m(const path_history& history) {
  auto sum = 0.0;
  for (std::size_t i = 1; i < history.size(); ++i)
    sum += distance_m(history[i - 1].at, history[i].at);
  return sum;
}

} // namespace

TEST_CASE("who has not moved has one place behind it") {
  path_history history;
  CHECK(history.size() == 0);
  for (auto i = 0; i < 100; ++i)
    history.pass(departure + i * 100ms, {5, 5});
  REQUIRE(history.size() == 1);
  CHECK(history[0].at == point{5, 5});
  CHECK(history[0].when == departure);
}

TEST_CASE("on a straight road ten points reach back about 200 m") {
  path_history history;
  const auto way = drive(history, 1000, straight_line);
  REQUIRE(history.size() == 10);
  CHECK(distance_m(way.back(), history[9].at) > 189);
  for (std::size_t i = 1; i < 10; ++i) {
    CHECK(distance_m(history[i - 1].at, history[i].at) <= 22.5);
    CHECK(distance_m(history[i - 1].at, history[i].at) > 20);
  }
}

TEST_CASE("the newest comes first, with the time it was passed") {
  path_history history;
  drive(history, 300, straight_line);
  for (std::size_t i = 0; i < history.size(); ++i) {
    const auto passed_s = to_seconds(history[i].when - departure);
    CHECK(history[i].at.x_m == doctest::Approx(14 * passed_s));
    if (i > 0)
      CHECK(history[i].when < history[i - 1].when);
  }
}

TEST_CASE("the way was never far from the lines between the points") {
  path_history history{path_history::capacity};
  const auto way = drive(history, 150, winding);
  REQUIRE(history.size() > 8);
  for (const auto p : way) {
    if (p.x_m > history[0].at.x_m)
      break;
    auto off_m = 1e9;
    for (std::size_t i = 1; i < history.size(); ++i)
      off_m = std::min(
          off_m, distance_to_segment_m(p, history[i - 1].at, history[i].at));
    CHECK(off_m <= 0.47);
  }
}

TEST_CASE("a bend takes more points than a straight") {
  path_history bend{path_history::capacity}, line{path_history::capacity};
  drive(bend, 150, winding);
  drive(line, 150, straight_line);
  CHECK(bend.size() > line.size() + 3);
}

TEST_CASE("there are no more points than asked for, and the oldest go") {
  path_history few{3};
  drive(few, 150, winding);
  CHECK(few.size() == 3);
  CHECK(few[2].at.x_m > 100);
  path_history too_many{1000};
  drive(too_many, 5000, [](double s_m) {
    return point{30 * std::cos(s_m / 30), 30 * std::sin(s_m / 30)};
  });
  CHECK(too_many.size() <= path_history::capacity);
}

TEST_CASE("what lies back more than 200 m is left out") {
  path_history history{path_history::capacity};
  drive(history, 2000, straight_line);
  CHECK(length_m(history) >= 200);
  CHECK(length_m(history) < 222.5);
}

TEST_CASE("a vehicle that crawls or creeps has been somewhere too") {
  path_history history;
  for (auto i = 0; i < 10000; ++i)
    history.pass(departure + i * 100ms, {0.02 * i, 0});
  CHECK(history.size() >= 9);
}

TEST_CASE("a place that is not a number is not passed") {
  path_history history;
  history.pass(departure, {std::numeric_limits<double>::quiet_NaN(), 0});
  CHECK(history.size() == 0);
}
