// Where cycles were computed, and what that took.
#include "recording/cycle_ledger.hpp"

#include "tests/support/made_up_run.hpp"

#include <doctest/doctest.h>

#include <cstdint>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::recording;
using namespace sofof::made_up;
using namespace std::chrono_literals;

namespace {

const service_name environment{"environment"};

/// What planning and the environment cost two vehicles, J.
cycle_ledger of_two_vehicles() {
  return cycle_ledger{{{{101, planning}, {0.5, 0.25, 0.125}},
                       {{102, planning}, {0.25, 0.25, 0.125}},
                       {{101, "environment"}, {2, 1, 0}}}};
}

} // namespace

TEST_CASE("cycles are paid for where they were computed") {
  auto x = of_two_vehicles();
  x.add(work_record{101, planning, 3, 0});
  x.add(work_record{102, planning, 4, 1});
  x.add(result(running(102), 100, 5s, 10ms, {}));
  x.add(result(running(102), 101, 5s, 10ms, {}));
  const auto cycles = x.cycles(planning, 102);
  CHECK(cycles.on_board == 4);
  CHECK(cycles.offloaded == 2);
  CHECK(cycles.offloaded_share() == doctest::Approx(2. / 6));
  const auto energy = x.energy(102);
  CHECK(energy.on_board_j == 4 * 0.25);
  CHECK(energy.offloading_j == 1 * 0.25 + 2 * 0.125);
  CHECK(energy.all_on_board_j == 6 * 0.25);
  CHECK(energy.saved_share() == doctest::Approx(1 - 1.5 / 1.5));
  CHECK(x.energy().j() == 3 * 0.5 + 1.5);
  CHECK(x.energy(101).saved_share() == 0.);
}

TEST_CASE("every service counts, alone and in the sum") {
  auto x = of_two_vehicles();
  x.add(work_record{101, planning, 2, 0});
  x.add(work_record{101, environment, 1, 1});
  CHECK(x.energy(service_name{planning}).j() == 2 * 0.5);
  CHECK(x.energy(environment).on_board_j == 2);
  CHECK(x.energy(environment).offloading_j == 1);
  CHECK(x.energy(101).j() == 1 + 2 + 1);
  CHECK(x.energy().j() == 1 + 2 + 1);
  CHECK(x.cycles(environment).on_board == 1);
  CHECK(x.cycles(service_name{planning}).on_board == 2);
}

TEST_CASE("an input is paid for when it is sent, whatever comes of it") {
  auto x = of_two_vehicles();
  x.add(work_record{101, planning, 0, 5});
  CHECK(x.energy().offloading_j == 5 * 0.25);
  CHECK_FALSE(x.energy().saved_share().has_value());
}

TEST_CASE("a cycle that two providers compute is one, with two results") {
  auto x = of_two_vehicles();
  auto other = running(101, 2);
  other.provider = 7;
  for (std::uint64_t cycle = 1; cycle <= 10; ++cycle) {
    x.add(result(running(101, 1), cycle, 5s, 10ms, {}));
    x.add(result(other, cycle, 5s, 12ms, {}));
  }
  CHECK(x.cycles(planning, 101).offloaded == 10);
  CHECK(x.cycles(planning, 101).results == 20);
  CHECK(x.energy(101).offloading_j == 20 * 0.125);
}

TEST_CASE("a cycle whose result comes too late is the vehicle's own, and its "
          "result is paid for all the same") {
  auto x = of_two_vehicles();
  auto late = result(running(101), 1, 5s, 90ms, {});
  late.used = false;
  x.add(late);
  x.add(work_record{101, planning, 1, 1});
  const auto cycles = x.cycles(planning, 101);
  CHECK(cycles.on_board == 1);
  CHECK(cycles.offloaded == 0);
  CHECK(x.energy(101).all_on_board_j == 0.5);
  CHECK(x.energy(101).offloading_j == 0.25 + 0.125);
  CHECK(*x.energy(101).saved_share() < 0);
  x.add(result(running(101), 1, 5s, 20ms, {}));
  CHECK(x.cycles(planning, 101).offloaded == 1); // an unused one hides none
}

TEST_CASE("what nothing is known of costs nothing") {
  auto x = of_two_vehicles();
  x.add(work_record{103, planning, 3, 3});
  CHECK(x.cycles(planning, 103).on_board == 3);
  CHECK(x.energy().j() == 0);
  CHECK_FALSE(x.energy(104).saved_share().has_value());
  CHECK_FALSE(x.cycles(environment).offloaded_share().has_value());
}
