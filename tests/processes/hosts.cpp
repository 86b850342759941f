// Providers and vehicles in processes of their own, as they should be.
#include "tests/processes/hosts.hpp"

#include "tests/support/contains.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

using namespace sofof::test;

namespace {

std::set<std::string> stations_in(const std::vector<row>& rows) {
  std::set<std::string> all;
  for (const auto& r : rows)
    all.insert(r.at("station"));
  return all;
}

/// @returns the median latency after the clocks got to know each other, ms.
double usual_latency_ms(const workplace& at, std::uint16_t port,
                        const std::string& out, const words& more) {
  drive_process drive{at, out, port, everywhere(6) + more};
  REQUIRE(drive.run().wait().code == 0);
  std::vector<double> all;
  for (const auto& r : cycles_of(drive.out()))
    if (number(r, "received_s") > 1)
      all.push_back(number(r, "latency_ms"));
  REQUIRE(all.size() > 100);
  const auto middle = all.begin() + static_cast<long>(all.size() / 2);
  std::ranges::nth_element(all, middle);
  return *middle;
}

} // namespace

TEST_CASE("two processes of vehicles share a provider") {
  const workplace at;
  const auto settings = patient(6);
  provider_process provider{at, "provider", settings};
  const words length{"--duration", "3s"};
  drive_process some{at, "some", provider.port(),
                     settings + length + words{"--station", "101-103"}};
  drive_process others{at, "others", provider.port(),
                       settings + length + words{"--station", "104-106"}};
  for (auto* drive : {&some, &others}) {
    const auto end = drive->run().wait();
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(end.err == "");
    CHECK(contains(end.out, "connected to provider mec"));
    const auto summary = summary_of(drive->out());
    check_safe(summary);
    check_one_source(drive->out());
    CHECK(summary["vehicles"] == 3);
    CHECK(summary["episodes"] == 3);
    CHECK(summary["ended_by"]["shutdown"] == 3);
  }
  CHECK(stations_in(cycles_of(some.out()))
        == std::set<std::string>{"101", "102", "103"});
  CHECK(stations_in(cycles_of(others.out()))
        == std::set<std::string>{"104", "105", "106"});

  const auto end = stop(provider.run());
  CAPTURE(end.err);
  CHECK(end.code == 0);
  const auto closed =
      episodes_of(provider.out(), "provider", "trajectory_planning");
  CHECK(closed.size() == 6);
  for (const auto& r : closed)
    CHECK(r.at("reason") == "shutdown");
  CHECK(events_of(provider.out(), "peer_connected").size() == 2);
  CHECK(events_of(provider.out(), "peer_lost").size() == 2);
  // Its sensors, which would see an empty road, are left out.
  CHECK(events_of(provider.out(), "doubted").empty());
}

TEST_CASE("a provider ends after its duration") {
  const workplace at;
  provider_process provider{at, "provider",
                            everywhere(1) + words{"--duration", "1s"}};
  const auto end = provider.run().wait();
  CHECK(end.code == 0);
  CHECK(summary_of(provider.out())["interrupted"] == false);
}

TEST_CASE("sides with different maps talk if both say that theirs is their "
          "own") {
  const workplace at;
  const auto map = at / "older.toml";
  const std::filesystem::path source{SOFOF_SOURCE_DIR};
  std::ofstream{map}
      << std::ifstream{source / "config/maps/ulm_lehr.toml"}.rdbuf()
      << "# an older one\n";
  const words older{"--set", "map=" + map.string()};
  const words own{"--own-map"}, length{"--duration", "3s"};
  const auto settings = patient(2);
  provider_process provider{at, "provider", settings + older + own};
  drive_process stranger{at, "stranger", provider.port(), settings + length};
  const auto refused = stranger.run().wait();
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "another map or other services"));
  CHECK(contains(refused.err, "--own-map"));
  drive_process drive{at, "drive", provider.port(), settings + length + own};
  const auto end = drive.run().wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  check_safe(summary_of(drive.out()));
  CHECK(summary_of(drive.out())["episodes"] == 2);
  CHECK(stop(provider.run()).code == 0);
}

TEST_CASE("vehicles may set off long before their provider") {
  const workplace at;
  const auto settings = everywhere(2);
  std::uint16_t port = 0;
  {
    provider_process first{at, "first", settings};
    port = first.port();
  }
  drive_process drive{at, "drive", port, settings};
  REQUIRE(wait_until([&] {
    return contains(drive.run().printed(), "no connection to provider mec");
  }));
  provider_process provider{at, "provider", settings, port};
  CHECK(wait_for_offloaded(drive, 2));
  CHECK(stop(drive.run()).code == 130);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("latencies are told right though clocks are wrong") {
  const workplace at;
  provider_process provider{at, "provider", everywhere(6)};
  const words length{"--duration", "3s"};
  const auto truth_ms = usual_latency_ms(at, provider.port(), "right", length);
  for (const std::string clock : {"500ms,50", "-500ms,50"}) {
    CAPTURE(clock);
    const auto told_ms = usual_latency_ms(
        at, provider.port(), clock, length + words{"--test-clock=" + clock});
    CHECK(std::abs(told_ms - truth_ms) < 2);
  }
}

TEST_CASE("processes of one machine name their folders after themselves") {
  const workplace at;
  const words brief{"--quiet", "--duration", "500ms"};
  const auto drive = at.run_sofof(
      words{"drive", scenario_file, "--provider", "127.0.0.1:1"} + brief);
  CHECK(drive.code == 0);
  CHECK(drive.out
        == "no connection to provider mec at 127.0.0.1:1: nobody listens "
           "there; trying again\n");
  const auto provide = at.run_sofof(
      words{"provide", scenario_file, "--listen", "127.0.0.1:0"} + brief);
  CHECK(provide.code == 0);
  CHECK(summary_of(at / "results/ulm_lehr-cars-1")["vehicles"] == 6);
  CHECK(summary_of(at / "results/ulm_lehr-mec-1")["vehicles"] == 0);
}
