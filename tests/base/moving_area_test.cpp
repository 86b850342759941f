// Areas that stay, and areas that ride with a vehicle.
#include "base/moving_area.hpp"

#include <doctest/doctest.h>

#include <chrono>

using namespace sofof;

namespace {

using namespace std::chrono_literals;

const polygon ten_m_square{{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}};

constexpr time_point start{100s};

} // namespace

TEST_CASE("an area that nobody moves stays where it is for ever") {
  const moving_area area{ten_m_square};
  for (const auto t : {time_point{}, start, time_point{1h}}) {
    CHECK(area.contains({10, 0}, t));
    CHECK_FALSE(area.contains({10.001, 0}, t));
    CHECK(area.at(t).corners()[0] == point{-10, -10});
  }
  CHECK(area.moved_at() == time_point{});
  CHECK(area.velocity_mps() == point{});
}

TEST_CASE("an area that was moved lies round its new place") {
  moving_area area{ten_m_square};
  area.move({50, 7}, {}, start);
  CHECK(area.contains({60, 7}, start));
  CHECK_FALSE(area.contains({39.9, 7}, start));
  CHECK(area.at(start + 5s).corners()[2] == point{60, 17});
}

TEST_CASE("between two moves an area goes on, and it is known where it was") {
  moving_area area{ten_m_square};
  area.move({50, 0}, {10, 0}, start);
  CHECK(area.contains({70, 0}, start + 1s));
  CHECK_FALSE(area.contains({71, 0}, start + 1s));
  CHECK_FALSE(area.contains({40, 0}, start + 1s));
  CHECK(area.contains({40, 0}, start));
  CHECK(area.contains({35, 0}, start - 500ms));
  CHECK(area.at(start + 2s).corners()[0] == point{60, -10});
  area.move({0, 0}, {}, start + 2s);
  CHECK(area.contains({0, 0}, start + 9s));
}
