// Tests of going where a cycle costs least.
#include "tests/support/roadside.hpp"

#include <limits>

using namespace sofof;
using namespace sofof::policies;
using test::comes_home;
using test::goes_to;
using test::roadside;

TEST_CASE_FIXTURE(roadside, "the provider of the greatest gain is asked") {
  const auto lodm = make_lodm("greedy_gain");
  add(1).cost.energy_j = 0.020;
  add(2);
  add(3).link.late = 0.1;
  const auto decision = ask(*lodm);
  CHECK(goes_to(decision) == 2);
  // On board 0.3 * (0.2 + 1), there 0.3 * (0.4 + 10/27).
  CHECK(std::get<run_at>(decision.what).advantage
        == doctest::Approx(0.3 * (0.8 - 10.0 / 27)));
  CHECK(goes_to(ask(*lodm)) == 2);
}

TEST_CASE_FIXTURE(roadside, "nobody is asked for a gain of the margin or less, "
                            "nor where nothing is known") {
  const auto lodm = make_lodm("greedy_gain");
  add(1).cost.energy_j = 0.016; // a gain of 0.062
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[0].cost.energy_j = 0.018; // 0.04
  CHECK(!goes_to(ask(*lodm)));
  providers[0] = {.id = 1, .at = {100, 0}};
  CHECK(!goes_to(ask(*lodm)));
  providers[0].cost.energy_j = std::numeric_limits<double>::quiet_NaN();
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside, "it comes home when the gain has gone, and not as "
                            "long as there is any") {
  const auto lodm = make_lodm("greedy_gain");
  CHECK(lodm->epoch_s() > 0);
  add(1).cost.energy_j = 0.020;
  runs_at(1);
  CHECK(!comes_home(ask(*lodm)));
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[0].link.late = 0.1;
  CHECK(comes_home(ask(*lodm)));
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside, "it comes home also from where the filter would "
                            "not let it go") {
  const auto lodm = make_lodm("greedy_gain");
  add(1, {-290, 0});
  CHECK(!goes_to(ask(*lodm)));
  runs_at(1);
  CHECK(!comes_home(ask(*lodm)));
  providers[0].link.late = 1;
  CHECK(comes_home(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside,
                  "it goes on to another provider that is better by "
                  "more than the margin, and rather there than home") {
  const auto lodm = make_lodm("greedy_gain");
  add(1);
  add(2).cost.energy_j = 0.006; // better by 0.044
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[1].cost.energy_j = 0.005;
  CHECK(goes_to(ask(*lodm)) == 2);
  providers[1].cost.energy_j = 0.010;
  providers[0].link.late = 1;
  CHECK(goes_to(ask(*lodm)) == 2);
  CHECK(!comes_home(ask(*lodm)));
}
