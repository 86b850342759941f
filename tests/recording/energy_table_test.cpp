// The energy of both ends: parts, sums, and what a split saves.
#include "recording/energy_table.hpp"

#include "tests/recording/energy_run.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::recording;
using namespace sofof::made_up;
using namespace std::chrono_literals;
using doctest::Approx;

namespace {

constexpr std::int64_t giga = 1'000'000'000;

/// One vehicle: a second at home, and a second with planning at the provider.
split_ledger of_two_seconds() {
  split_ledger x{run_with_chain()};
  drive_on(x, 101);
  x.add(work(101, "look", 0s, 1s, 10));
  x.add(work(101, "plan", 0s, 1s, 10));
  x.add(switched(running(101, 1, "plan"), true, 1s));
  drive_on(x, 101);
  x.add(work(101, "look", 1s, 2s, 10));
  x.add(work(101, "plan", 1s, 2s, 0, 200, 100));
  for (int k = 0; k < 10; ++k)
    x.add(served(101, "plan", 20ms));
  return x;
}

energy_table table_of(const split_ledger& x, const load_table& load = {}) {
  return energy_of(x, run_with_chain().energy, load, 2s);
}

} // namespace

TEST_CASE("each end is paid for in the split in which it worked") {
  const auto all = table_of(of_two_seconds());
  REQUIRE(all.splits.size() == 2 + 1);
  const auto& home = all.splits.at({0, {"", ""}});
  CHECK(home.spent.nj() == 20 * giga); // 0.2 s of 100 W
  CHECK(home.saved_nj() == 0);
  CHECK_FALSE(home.break_even_w().has_value());
  const auto& there = all.splits.at({0, {"", "mec"}});
  CHECK(there.spent.computing_nj == 10 * giga);
  CHECK(there.spent.resting_nj == giga * 5 / 2); // a quarter of 10 J
  CHECK(there.spent.framework_nj == giga * 5 / 4);
  CHECK(there.spent.sending_nj == giga / 5);
  CHECK(there.spent.receiving_nj == giga / 20);
  CHECK(there.spent.server_busy_nj == giga * 3 / 5);
  CHECK(there.spent.server_idle_nj == giga / 5);
  CHECK(there.home_nj == 20 * giga);
  CHECK(joules(there.saved_nj()) == Approx(20 - 10 - 2.5 - 1.25 - .25 - .8));
  CHECK(*there.saved_j_per_km() == Approx(100 * joules(there.saved_nj())));
  // 2.3 J beside the computer's; 0.2 - 0.1 - 0.025 s less.
  CHECK(*there.break_even_w() == Approx(2.3 / 0.075));
}

TEST_CASE("the sum of parts is the total, to the nanojoule") {
  auto x = of_two_seconds();
  x.add(work(102, "look", 0s, 1s, 3, 12'345, 678));
  x.add(work(102, "warm", 0s, 1s, 7, 3, 1));
  const auto all = table_of(x);
  std::int64_t rows = 0, splits = 0;
  for (const auto& row : all.rows)
    rows += row.spent.nj();
  for (const auto& [which, sum] : all.splits)
    splits += sum.spent.nj();
  CHECK(all.all.spent.nj() == rows);
  CHECK(all.all.spent.nj() == splits);
  CHECK(all.all.spent.nj()
        == all.all.spent.vehicle_nj() + all.all.spent.radio_nj()
               + all.all.spent.server_nj());
  CHECK(all.vehicles == 2);
}

TEST_CASE("what a provider computes for results that nobody gets is paid for "
          "too, by no split") {
  load_table load;
  auto& workers = load.servers.emplace_back();
  workers.provider = "mec";
  workers.what = "workers";
  workers.of.servers = 2;
  workers.of.busy_by["plan"] = {300ms, {}};
  const auto all = table_of(of_two_seconds(), load);
  const auto& left = all.rows.back();
  CHECK_FALSE(left.station.has_value());
  CHECK(left.served() == 100ms);
  CHECK(left.spent.server_busy_nj == giga * 3 / 10);
  CHECK(all.all.spent.server_busy_nj == giga * 9 / 10);
  CHECK(all.splits.at({0, {"", "mec"}}).spent.server_busy_nj == giga * 3 / 5);
  CHECK(all.unused_server_j == Approx(2 * 2 - 0.3));
}

TEST_CASE("a service that was never at home would have taken there what its "
          "configuration says; else what it took there") {
  split_ledger x{run_with_chain()};
  x.add(switched(running(101, 1, "plan"), true, 0s));
  drive_on(x, 101);
  CHECK(table_of(x).splits.at({0, {"", "mec"}}).home_nj == 20 * giga);
  auto slow = work(102, "plan", 0s, 1s, 10);
  slow.computing = 200ms; // twice as long as configured
  x.add(slow);
  CHECK(table_of(x).splits.at({0, {"", "mec"}}).home_nj == 30 * giga);
}

TEST_CASE("a vehicle of unknown power is in no table") {
  split_ledger x{run_with_chain()};
  x.add(work(103, "plan", 0s, 1s, 10));
  const auto all = table_of(x);
  CHECK(all.rows.empty());
  CHECK(all.all.spent.nj() == 0);
}

TEST_CASE("energy.csv has a line for each service of each vehicle and split") {
  const auto text = to_csv(table_of(of_two_seconds()), run_with_chain().energy);
  CHECK(test::contains(text, "\n101,plan,vehicle>mec,plan,mec,1.000000000,"
                             "10.000,0,0.000000000,0.100000000,200,100,10,"
                             "0.200000000,0.000000000,2.500000000,"));
  CHECK(test::contains(text, "\n101,plan,vehicle>vehicle,look,vehicle,"));
  CHECK(test::contains(text, "\n101,warm,vehicle,warm,vehicle,2.000000000,"));
}
