// What a station tells of a body has to fit what it told before.
#include "planners/plausibility/motion_check.hpp"

#include "base/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace sofof;
using namespace sofof::planners;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr time_point first_word{100s};

perceived_object car_along(double x_m, double speed_mps = 0) {
  return {{x_m, 0}, 0, speed_mps, 0, 5.1, 1.89};
}

timed_body word_after(duration after, const perceived_object& x) {
  return {first_word + after, x};
}

} // namespace

TEST_CASE("motions that tyres can hold are explained, however rare the words") {
  const random_stream dice{3, "motions"};
  for (std::uint64_t k = 0; k < 2000; ++k) {
    perceived_object x{
        {0, 0}, dice.uniform(-3, 3, k, 0), dice.uniform(0, 20, k, 1), 0, 5.1,
        1.89};
    timed_body last{first_word, x};
    const auto period = from_seconds(dice.uniform(0.1, 1.0, k, 2));
    const auto accel_mps2 = dice.uniform(-8, 4, k, 3);
    const auto turns = dice.uniform(-1, 1, k, 4); // as far as tyres hold
    auto off_m = 0.0;
    for (auto t = first_word; t < first_word + 5s;) {
      for (const auto next = t + period; t < next; t += 10ms) {
        x = moved_on(x, 0.01);
        const auto v_mps = x.speed_mps;
        x.heading_rad +=
            turns * std::min(0.15, 6 / (1 + v_mps * v_mps)) * v_mps * 0.01;
        x.speed_mps = std::clamp(v_mps + accel_mps2 * 0.01, 0.0, 40.0);
      }
      const timed_body next{t, x};
      off_m = std::max(off_m, unexplained_m(last, next));
      last = next;
    }
    CHECK(off_m == 0);
  }
}

TEST_CASE("what speed and time do not explain is told in metres") {
  CHECK(unexplained_m(word_after(0s, car_along(0, 10)),
                      word_after(100ms, car_along(1, 10)))
        == 0);
  CHECK(unexplained_m(word_after(0s, car_along(0)),
                      word_after(100ms, car_along(30)))
        > 25);
  CHECK(unexplained_m(word_after(0s, car_along(0, 10)),
                      word_after(400ms, car_along(0, 10)))
        > 0.5);
  CHECK(unexplained_m(word_after(0s, car_along(0, 10)),
                      word_after(100ms, car_along(1, 0)))
        > 0);
  auto turned = car_along(1, 10);
  turned.heading_rad = 2;
  CHECK(
      unexplained_m(word_after(0s, car_along(0, 10)), word_after(100ms, turned))
      > 0);
  CHECK(unexplained_m(word_after(0s, car_along(0)),
                      word_after(3s, car_along(300)))
        == 0);
}

TEST_CASE("one wrong word is left out, and the next true one is believed") {
  steady_word station;
  CHECK(station.check(word_after(0ms, car_along(0, 10))) == 0);
  CHECK(station.check(word_after(100ms, car_along(31, 10))) > 25);
  CHECK(station.check(word_after(200ms, car_along(2, 10))) == 0);
  CHECK(station.check(word_after(300ms, car_along(3, 10))) == 0);
}

TEST_CASE("a new place is believed after three words and half a second") {
  steady_word station;
  CHECK(station.check(word_after(0ms, car_along(0))) == 0);
  for (auto t = 100ms; t < 600ms; t += 100ms)
    CHECK(station.check(word_after(t, car_along(50))) > 0);
  CHECK(station.check(word_after(600ms, car_along(50))) == 0);
}

TEST_CASE("who is somewhere else each time is never believed") {
  steady_word station;
  const random_stream dice{4, "places"};
  CHECK(station.check(word_after(0ms, car_along(0))) == 0);
  for (std::uint64_t k = 1; k < 600; ++k)
    CHECK(station.check(word_after(
              k * 100ms, car_along(dice.uniform(100, 2000, k) + 20 * k)))
          > 0);
}

TEST_CASE("a word of the same time, or an earlier one, has to fit as well") {
  steady_word station;
  CHECK(station.check(word_after(1s, car_along(10, 10))) == 0);
  CHECK(station.check(word_after(900ms, car_along(9, 10))) == 0);
  CHECK(station.check(word_after(900ms, car_along(60, 10))) > 40);
  CHECK(station.check(word_after(1s, car_along(60, 10))) > 40);
}
