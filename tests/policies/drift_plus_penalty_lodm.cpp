// Tests of the policy that saves energy within a budget of late results; its
// core has tests of its own.
#include "tests/support/roadside.hpp"

using namespace sofof;
using namespace sofof::policies;
using test::comes_home;
using test::goes_to;
using test::make_lodm_with;
using test::roadside;

TEST_CASE_FIXTURE(roadside,
                  "without debts the place of least energy is chosen, "
                  "whatever may be late") {
  const auto lodm = make_lodm("drift_plus_penalty");
  add(1).cost.energy_j = 0.012;
  auto& cheap = add(2);
  cheap.link.late = 1;
  CHECK(goes_to(ask(*lodm)) == 2);
  CHECK(goes_to(ask(*lodm)) == 2);
}

TEST_CASE_FIXTURE(roadside,
                  "missed cycles are debts that make it cautious, and "
                  "good ones pay them back") {
  // V 0.5 J/J: a cycle at the provider is cheaper by 0.0085, a debt of one
  // missed cycle makes its price 0.02 * 0.99 higher.
  const auto lodm =
      make_lodm_with("drift_plus_penalty", {.numbers = {{"V", 0.5}}});
  add(1).link.late = 0.02;
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  lodm->observe(cycle(true));
  CHECK(comes_home(ask(*lodm)));
  runs_at(std::nullopt);
  CHECK(!goes_to(ask(*lodm)));
  // 0.0085 / 0.02 = 0.425 is left when 57 good cycles are over.
  lodm->observe(cycle(false, 56));
  CHECK(!goes_to(ask(*lodm)));
  lodm->observe(cycle(false, 0.6));
  CHECK(!goes_to(ask(*lodm)));
  lodm->observe(cycle(false, 0.6));
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(roadside, "each service has debts of its own") {
  const auto lodm =
      make_lodm_with("drift_plus_penalty", {.numbers = {{"V", 0.5}}});
  add(1).link.late = 0.02;
  runs_at(1);
  lodm->observe(cycle(true));
  seen.service = "other";
  CHECK(goes_to(ask(*lodm)) == 1);
  seen.service = "any";
  CHECK(comes_home(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside,
                  "who spends more energy than the budget saves where "
                  "it did not before") {
  // Late results cost 0.02 Z, and energy (0.01 + Y) 0.017: as Z is 1, a debt of
  // 1.16 J decides for the provider.
  const auto lodm =
      make_lodm_with("drift_plus_penalty",
                     {.numbers = {{"V", 0.01}, {"violation_budget", 0}}});
  const auto budget = make_lodm_with("drift_plus_penalty",
                                     {.numbers = {{"V", 0.01},
                                                  {"violation_budget", 0},
                                                  {"energy_budget_j", 0.02}}});
  add(1).link.late = 0.02;
  for (auto* each : {lodm.get(), budget.get()}) {
    each->observe(cycle(true));
    CHECK(!goes_to(ask(*each)));
    each->observe(cycle(false, 200));
  }
  CHECK(!goes_to(ask(*lodm)));
  CHECK(goes_to(ask(*budget)) == 1);
}

TEST_CASE_FIXTURE(roadside, "of equal prices nothing changes") {
  const auto lodm = make_lodm("drift_plus_penalty");
  add(1).cost = seen.on_board;
  add(2).cost = seen.on_board;
  CHECK(!goes_to(ask(*lodm)));
  runs_at(2);
  CHECK(goes_to(ask(*lodm)) == 2);
}
