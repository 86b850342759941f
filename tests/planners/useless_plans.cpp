// Plans that harm nobody, but do not get the car anywhere: which of them the
// judge of plans refuses in the end, and which never.
#include "planners/judges/plan_judge.hpp"
#include "tests/planners/judged_drive.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace sofof;
using namespace sofof::test;

TEST_CASE_FIXTURE(judged_drive, "braking for nothing is obeyed at first, and "
                                "refused within half a second") {
  const auto begin = now;
  CHECK(refused_within(2s, -8) == "braking");
  CHECK(now - begin >= 400ms);
  CHECK(now - begin <= 650ms);
}

TEST_CASE_FIXTURE(judged_drive, "braking for what the car sees 0.4 s later is "
                                "no lie") {
  const auto begin = now;
  CHECK(refused_of(
            [&] {
              if (now - begin >= 400ms && seen.objects.empty())
                see_car(s_m + 12, 0, 0, 0);
              return plan(-7);
            },
            1s)
            .empty());
}

TEST_CASE_FIXTURE(judged_drive, "stopping where the own planner would go on is "
                                "refused soon") {
  own_accel_mps2 = 1;
  const auto begin = now;
  CHECK(refused_within(10s, -3) == "standing");
  CHECK(now - begin > 1s);
  CHECK(now - begin < 4s);
}

TEST_CASE_FIXTURE(judged_drive,
                  "driving at half the speed that the own planner "
                  "would reach is refused within 10 s") {
  own_accel_mps2 = 1;
  speed_mps = 5;
  CHECK(refused_within(10s, 0) == "standing");
}

TEST_CASE_FIXTURE(judged_drive, "plans that always drive soon, and never do, "
                                "are refused within 5 s") {
  own_accel_mps2 = 1;
  speed_mps = 0;
  const auto soon = [&] {
    auto x = plan(1);
    for (auto& p : x.points) { // stands for 1.8 s
      const auto t = std::max(0.0, p.t_s - 1.8);
      p.speed_mps = t;
      p.accel_mps2 = t > 0 ? 1 : 0;
      p.s_m = s_m + t * t / 2;
      p.at = {p.s_m, d_m};
    }
    return x;
  };
  CHECK(refused_of(soon, 5s) == "standing");
}

TEST_CASE_FIXTURE(judged_drive, "plans that always brake now and speed up "
                                "later are refused before the car stands for "
                                "long") {
  own_accel_mps2 = 1;
  const auto later = [&] {
    auto x = plan(1, 0, 10);
    auto s = s_m, v = speed_mps;
    for (auto& p : x.points) {
      p.s_m = s;
      p.at = {s, d_m};
      p.speed_mps = v;
      p.accel_mps2 = p.t_s < 0.45 ? -4 : 1;
      s += 0.1 * v;
      v = std::max(0.0, v + 0.1 * p.accel_mps2);
    }
    return x;
  };
  CHECK(refused_of(later, 5s) == "standing");
}

TEST_CASE_FIXTURE(judged_drive, "a little slower than alone is good for ever") {
  own_accel_mps2 = 0;
  speed_mps = 7.5;
  const auto slower = [&] {
    auto x = plan(0);
    for (auto& p : x.points)
      p.s_m = s_m + 0.96 * (p.s_m - s_m);
    return x;
  };
  CHECK(refused_of(slower, 120s).empty());
}

TEST_CASE_FIXTURE(judged_drive, "standing is used for as long as it takes") {
  speed_mps = 0;
  SUBCASE("where the own planner would stand, too") {
    own_accel_mps2 = 0;
  }
  SUBCASE("for who comes to cross where nobody is granted anything") {
    own_accel_mps2 = 1;
    granted = false;
    see_car(s_m + 12, 8, 1.5, 0);
  }
  CHECK(refused_within(60s, 0).empty());
}
