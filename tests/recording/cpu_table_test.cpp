// Tests of what a ledger of computing time means.
#include "recording/cpu_table.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::recording;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

/// Two vehicles with two services, 10 s; one of them remote for 4 s.
cpu_table two_vehicles() {
  const cpu_account one{101, {}, false}, one_far{101, {}, true};
  const cpu_account plan{101, "trajectory_planning", false};
  const cpu_account plan_far{101, "trajectory_planning", true};
  const cpu_account two{102, {}, false};
  const cpu_account plan_two{102, "trajectory_planning", false};
  const cpu_account climate{101, "cabin_climate", false};
  return {{
              {{}, "vehicle", 900ms, 20s, 9000},
              {{}, "service_instance", 800ms, 4s, 80}, // a provider's
              {one, "service_requester", 4ms, 6s, 60},
              {one_far, "service_requester", 6ms, 4s, 60},
              {climate, "requester_manager", 1ms, 10s, 10},
              {climate, "service_instance", 700ms, 10s, 10},
              {plan, "requester_manager", 2ms, 6s, 20},
              {plan, "service_instance", 60ms, 6s, 120},
              {plan_far, "requester_manager", 5ms, 4s, 20},
              {plan_far, "qos_watchdog", 1ms, 4s, 30},
              {plan_far, "service_instance", 2ms, 4s, 80},
              {two, "service_requester", 1ms, 10s, 10},
              {plan_two, "service_instance", 100ms, 10s, 200},
          },
          10s,
          5s,
          1us};
}

} // namespace

TEST_CASE("shares are those of one vehicle, mean of all") {
  const auto f = figures_of(two_vehicles(), "trajectory_planning").value();
  CHECK(f.shares.active == near(1.0, 1e-12));           // 160 ms in 16 s
  CHECK(f.shares.inactive == near(0.05, 1e-12));        // 2 ms in 4 s
  CHECK(f.requester_mean == near(0.1, 1e-12));          // 20 ms in 20 s
  CHECK(f.shares.requester == near(0.05, 1e-12));       // 8 ms in 16 s
  CHECK(f.shares.requester_remote == near(0.3, 1e-12)); // 12 ms in 4 s
  CHECK(f.vehicles == 2);
  CHECK(f.active_s == 16);
  CHECK(f.inactive_s == 4);
  CHECK(f.overhead == near(0.00105, 1e-12)); // 210 turns in 20 s
}

TEST_CASE("a service that was never remote has no figures") {
  auto table = two_vehicles();
  CHECK(figures_of(table, "cabin_climate") == std::nullopt);
  CHECK(figures_of(table, "no_service") == std::nullopt);
  CHECK(figures_of({}, "trajectory_planning") == std::nullopt);
}

TEST_CASE("cpu.csv has a line for each account, and two for all together") {
  const cpu_table table{
      {{{}, "vehicle", 900ms, 20s, 9000},
       {{101, {}, true}, "service_requester", 4ms, 4s, 60},
       {{101, "x", false}, "qos_watchdog", 1ms, duration{}, 5}},
      10s,
      5s,
      1us};
  CHECK(to_csv(table)
        == "station,actor,service,source,cpu_s,time_s,percent,wakes\n"
           ",vehicle,,,0.900000000,20.000000000,4.500000,9000\n"
           "101,service_requester,,remote,0.004000000,4.000000000,0.100000,60\n"
           "101,qos_watchdog,x,local,0.001000000,0.000000000,,5\n"
           ",(measuring),,,0.018130000,10.000000000,0.181300,9065\n"
           ",(process),,,5.000000000,10.000000000,50.000000,9065\n");
}

TEST_CASE("a meter begins when it is made") {
  time_point now{1h};
  cpu_ledger ledger{[&now] { return now; }};
  ledger.add_turn(1, "link", 1s);
  const cpu_meter meter{ledger, now};
  ledger.add_turn(1, "link", 2ms);
  now += 3s;
  const auto table = meter.read(now);
  REQUIRE(table.lines.size() == 1);
  CHECK(table.lines[0].cpu == 2ms);
  CHECK(table.length == 3s);
  CHECK(table.process_cpu >= 0s);
  CHECK(table.process_cpu < 3s);
  CHECK(table.look > 0ns);
  CHECK(table.look < 100us);
}

TEST_CASE("runs together are one long run: each share by its own time") {
  const cpu_figures first{{10, 2, 1, 4}, 2, 6, 30, 10, 0.1};
  const cpu_figures second{{20, 4, 3, 8}, 4, 6, 10, 30, 0.2};
  const auto all = together(std::vector{first, second});
  CHECK(all.shares.active == near(12.5, 1e-9));
  CHECK(all.shares.requester == near(1.5, 1e-9));
  CHECK(all.shares.inactive == near(3.5, 1e-9));
  CHECK(all.shares.requester_remote == near(7, 1e-9));
  CHECK(all.requester_mean == near(3, 1e-9));
  CHECK(all.overhead == near(0.15, 1e-9));
  CHECK(all.active_s == 40);
  CHECK(all.inactive_s == 40);
  CHECK(all.vehicles == 6);
}
