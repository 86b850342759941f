// What was done goes to the split in which it was done, and none gets lost.
#include "recording/split_ledger.hpp"

#include "tests/recording/energy_run.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::recording;
using namespace sofof::made_up;
using namespace std::chrono_literals;
using doctest::Approx;

namespace {

const split at_home{"", ""};
const split planned_there{"", "mec"};

} // namespace

TEST_CASE("what was told of a time is shared by how long each split lasted") {
  split_ledger x{run_with_chain()};
  x.add(switched(running(101, 1, "plan"), true, 1700ms));
  x.add(work(101, "look", 1s, 2s, 9, 101, 7));
  const auto& splits = x.uses().at({101, 0});
  const auto& before = splits.at(at_home).services[0];
  const auto& after = splits.at(planned_there).services[0];
  CHECK(before.computed == 6);
  CHECK(after.computed == 3);
  CHECK(before.octets_up == 71);
  CHECK(before.octets_up + after.octets_up == 101);
  CHECK(before.octets_down + after.octets_down == 7);
  CHECK(before.computing + after.computing == 90ms);
}

TEST_CASE("of what thirds share none gets lost by rounding") {
  split_ledger x{run_with_chain()};
  x.add(switched(running(101, 1, "look"), true, 1'333'333'333ns));
  x.add(switched(running(101, 1, "plan"), true, 1'666'666'667ns));
  x.add(work(101, "plan", 1s, 2s, 1, 100));
  std::uint64_t octets = 0, results = 0;
  for (const auto& [where, use] : x.uses().at({101, 0})) {
    octets += use.services[1].octets_up;
    results += use.services[1].computed;
  }
  CHECK(x.uses().at({101, 0}).size() == 3);
  CHECK(octets == 100);
  CHECK(results == 1);
}

TEST_CASE("time and way are those that were driven in a split") {
  split_ledger x{run_with_chain()};
  drive_on(x, 101);
  x.add(switched(running(101, 1, "plan"), true, 1250ms));
  drive_on(x, 101);
  const auto& splits = x.uses().at({101, 0});
  CHECK(splits.at(at_home).driven == 1250ms);
  CHECK(splits.at(planned_there).driven == 750ms);
  CHECK(splits.at(planned_there).distance_m == Approx(7.5));
  // The service by itself has stayed at home.
  CHECK(x.uses().at({101, 1}).at(split{""}).driven == 2s);
}

TEST_CASE("who appears later has driven from then on") {
  split_ledger x{run_with_chain()};
  x.add(messages::event_record{at(5s), messages::event_type::appeared, 102});
  x.add(switched(running(102, 1, "plan"), true, 5500ms));
  drive_on(x, 102);
  CHECK(x.uses().at({102, 0}).at(planned_there).driven == 500ms);
}

TEST_CASE("a result is its provider's, in the split in which it came") {
  split_ledger x{run_with_chain()};
  x.add(served(101, "plan", 4ms));
  x.add(switched(running(101, 1, "plan"), true, 1s));
  x.add(served(101, "plan", 5ms));
  x.add(served(101, "plan", 6ms));
  const auto& splits = x.uses().at({101, 0});
  CHECK(splits.at(at_home).services[1].served.at("mec") == 4ms);
  CHECK(splits.at(planned_there).services[1].served.at("mec") == 11ms);
  CHECK(splits.at(planned_there).services[1].results == 2);
}

TEST_CASE("changes without end take no more memory, and lose nothing") {
  split_ledger x{run_with_chain()};
  for (int k = 0; k < 1000; ++k) {
    x.add(switched(running(101, 1, "plan"), k % 2 == 0, k * 1s + 500ms));
    x.add(work(101, "look", k * 1s, (k + 1) * 1s, 10));
  }
  std::uint64_t all = 0;
  for (const auto& [where, use] : x.uses().at({101, 0}))
    all += use.services[0].computed;
  CHECK(all == 10'000);
}
