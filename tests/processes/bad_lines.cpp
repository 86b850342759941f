// Vehicles behind a line that delays, holds up, goes dead and is cut.
#include "tests/processes/hosts.hpp"
#include "tests/support/bad_line.hpp"

#include <algorithm>
#include <map>
#include <string>

using namespace sofof::test;

namespace {

constexpr double longest_ms = 50;      // latency of trajectory_planning
constexpr double longest_age_ms = 500; // of its inputs

bool same_service(const row& r, const event& e) {
  return r.at("station") == std::to_string(e["station"].get<int>())
         && service_of(r) == service_of(e);
}

/// The watchdog barks where results came too late or stopped coming, and
/// nowhere else.
void check_violations(const std::filesystem::path& folder) {
  auto cycles = cycles_of(folder);
  auto violations = events_of(folder, "violation");
  std::erase_if(violations, [](const event& e) {
    return e["service"] != "trajectory_planning";
  });
  for (const auto& e : violations) {
    const auto t_s = time_of(e);
    const row* last = nullptr;
    for (const auto& r : cycles)
      if (same_service(r, e) && number(r, "received_s") <= t_s)
        last = &r;
    CAPTURE(e);
    REQUIRE(last != nullptr);
    if (e["detail"].get<std::string>().starts_with("qos_latency "))
      CHECK(number(*last, "latency_ms") > longest_ms);
    else if (e["detail"].get<std::string>().starts_with("qos_input_age "))
      CHECK(number(*last, "input_age_ms") > longest_age_ms);
    else
      CHECK(t_s - number(*last, "received_s") > longest_gap_s);
  }
  for (const auto& r : cycles) {
    CAPTURE(r);
    if (r.at("used") == "1")
      CHECK(number(r, "latency_ms") <= longest_ms);
    if (r.at("interarrival_ms").empty()) // the first, or none in time yet
      continue;
    const auto late = number(r, "latency_ms") > longest_ms
                      || number(r, "interarrival_ms") > 1e3 * longest_gap_s;
    if (late)
      CHECK(std::ranges::any_of(violations, [&](const event& e) {
        return same_service(r, e)
               && time_of(e) <= number(r, "received_s") + turn_s;
      }));
  }
}

std::size_t count_events(const std::filesystem::path& folder,
                         const std::string& what) {
  return events_of(folder, what).size();
}

/// @returns how many results came after a later one of another provider.
std::size_t count_overtaken(const std::filesystem::path& folder) {
  std::map<std::string, double> latest_s; // made by a provider, of all so far
  std::size_t overtaken = 0;
  for (const auto& r : cycles_of(folder)) {
    const auto made_s = number(r, "created_s");
    overtaken += std::ranges::any_of(latest_s, [&](const auto& other) {
      return other.first != r.at("provider") && other.second > made_s;
    });
    auto& last_s = latest_s[r.at("provider")];
    last_s = std::max(last_s, made_s);
  }
  return overtaken;
}

} // namespace

TEST_CASE("where messages of one provider overtake those of another, "
          "violations are counted right, and there is one source at a time") {
  using namespace std::chrono_literals;
  const workplace at;
  at.write(scenario_file, read_file(at / scenario_file)
                              + "\n[[provider]]\nname = \"far\"\n"
                                "area_radius_m = 3000.0\nrange_m = 6000.0\n");
  const auto settings = everywhere(12);
  provider_process near{at, "near", settings + words{"--name", "mec"}};
  provider_process far{at, "far", settings + words{"--name", "far"}};
  bad_line quick{near.port(), {2ms, 30ms, 0.01, 200ms}, 1};
  bad_line slow{far.port(), {15ms, 20ms, 0.01, 200ms}, 2};
  const auto to = [](const std::string& name, const bad_line& line) {
    return words{"--provider",
                 name + "=127.0.0.1:" + std::to_string(line.port())};
  };
  drive_process drive{at, "drive",
                      words{"drive", scenario_file, "--quiet", "--out", "drive",
                            "--duration", "8s"}
                          + to("mec", quick) + to("far", slow) + settings};
  const auto end = drive.run().wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  CHECK(count_overtaken(drive.out()) > 0);
  CHECK(count_events(drive.out(), "violation") > 0);
  check_safe(summary_of(drive.out()));
  check_violations(drive.out());
  check_one_source(drive.out());
  CHECK(stop(near.run()).code == 0);
  CHECK(stop(far.run()).code == 0);
}

TEST_CASE("on a line that jitters and loses, violations are counted right, and "
          "there is one source at a time") {
  using namespace std::chrono_literals;
  const workplace at;
  const auto settings = everywhere(6);
  provider_process provider{at, "provider", settings};
  bad_line line{provider.port(), {5ms, 30ms, 0.01, 200ms}, 1};
  drive_process drive{at, "drive", line.port(),
                      settings + words{"--duration", "8s"}};
  const auto end = drive.run().wait();
  CAPTURE(end.err);
  CHECK(end.code == 0);
  const auto summary = summary_of(drive.out());
  CHECK(summary["episodes"] >= 6);
  CHECK(count_events(drive.out(), "violation") > 0);
  check_safe(summary);
  check_violations(drive.out());
  check_one_source(drive.out());
  CHECK(stop(provider.run()).code == 0);
}

TEST_CASE("a line that is dead for less than a second loses results, but no "
          "connection") {
  const workplace at;
  const auto settings = everywhere(6);
  provider_process provider{at, "provider", settings};
  bad_line line{provider.port(), {}, 1};
  drive_process drive{at, "drive", line.port(), settings};
  REQUIRE(wait_for_offloaded(drive, 6));
  line.interrupt();
  pass(0.4);
  line.restore();
  pass(3);
  CHECK(stop(drive.run()).code == 130);
  CHECK(count_events(drive.out(), "provider_lost") == 0);
  const auto times = remote_times(drive.out());
  CHECK(times.size() == 12);
  CHECK(summary_of(drive.out())["ended_by"]["qos_gap"] == 6);
  check_safe(summary_of(drive.out()));
  check_violations(drive.out());
  check_one_source(drive.out());
}

TEST_CASE("a line that goes dead for longer is given up, and taken up again "
          "when it is back") {
  const workplace at;
  const auto settings = everywhere(6);
  provider_process provider{at, "provider", settings};
  bad_line line{provider.port(), {}, 1};
  drive_process drive{at, "drive", line.port(), settings};
  REQUIRE(wait_for_offloaded(drive, 6));
  line.interrupt();
  pass(2.5);
  line.restore();
  const auto restored = monotonic::now();
  CHECK(wait_until([&] { // at the provider, who has written nothing yet
    return seconds(monotonic::now() - restored) > 3.5;
  }));
  CHECK(stop(drive.run()).code == 130);
  CHECK(stop(provider.run()).code == 0);
  CHECK(count_events(drive.out(), "provider_lost") == 1);
  CHECK(count_events(provider.out(), "peer_lost") == 2);
  const auto times = remote_times(drive.out());
  CHECK(times.size() == 12);
  const auto restored_s = provider.latest_s(restored);
  for (const auto& r :
       episodes_of(provider.out(), "provider", "trajectory_planning"))
    if (r.at("reason") == "shutdown")
      CHECK(number(r, "accepted_s") <= restored_s + 3);
  check_safe(summary_of(drive.out()));
  check_violations(drive.out());
  check_one_source(drive.out());
}

TEST_CASE("a provider is found at the end of a slow line, too") {
  const workplace at;
  const auto settings = everywhere(2);
  provider_process provider{at, "provider", settings};
  line_faults slow;
  slow.delay = std::chrono::milliseconds{150};
  bad_line line{provider.port(), slow, 1};
  drive_process drive{at, "drive", line.port(), settings};
  CHECK(wait_until(
      [&] { return count_events(drive.out(), "provider_connected") > 0; }));
  pass(1.5);
  CHECK(stop(drive.run()).code == 130);
  CHECK(stop(provider.run()).code == 0);
  CHECK(count_events(drive.out(), "provider_lost") == 0);
  check_safe(summary_of(drive.out()));
}

TEST_CASE("a connection that is cut is made again") {
  const workplace at;
  const auto settings = patient(6);
  provider_process provider{at, "provider", settings};
  bad_line line{provider.port(), {}, 1};
  drive_process drive{at, "drive", line.port(), settings};
  REQUIRE(wait_for_offloaded(drive, 6));
  line.cut();
  pass(3);
  CHECK(stop(drive.run()).code == 130);
  CHECK(count_events(drive.out(), "provider_lost") == 1);
  CHECK(remote_times(drive.out()).size() == 12);
  check_safe(summary_of(drive.out()));
  check_one_source(drive.out());
}
