// Providers and processes of vehicles that are stopped or killed, and what the
// other side makes of it.
#include "tests/processes/hosts.hpp"

#include <algorithm>
#include <map>

using namespace sofof::test;

namespace {

/// @returns when each vehicle received its last remote result before a time.
std::map<std::uint32_t, double> last_results(const std::vector<row>& cycles,
                                             double before_s) {
  std::map<std::uint32_t, double> last;
  for (const auto& r : cycles)
    if (number(r, "received_s") < before_s)
      last[static_cast<std::uint32_t>(number(r, "station"))] =
          number(r, "received_s");
  return last;
}

/// What has been closed is closed on both sides and written down whole.
void check_closed(const std::filesystem::path& folder, const std::string& side,
                  std::size_t services, const std::string& reason) {
  const auto closed = episodes_of(folder, side, "trajectory_planning");
  CHECK(closed.size() == services);
  for (const auto& r : closed)
    CHECK(r.at("reason") == reason);
}

} // namespace

TEST_CASE("twenty vehicles survive the death of their provider, and find it "
          "again") {
  constexpr std::size_t vehicles = 20;
  const workplace at;
  const auto settings = patient(vehicles);
  std::optional<provider_process> provider{std::in_place, at, "first",
                                           settings};
  const auto port = provider->port();
  drive_process drive{at, "drive", port, settings};
  REQUIRE(wait_for_offloaded(drive, vehicles));

  provider->run().send(SIGKILL);
  provider->run().wait();
  pass(0.5);
  provider.emplace(at, "second", settings, port);
  pass(4);
  const auto end = stop(drive.run());
  CAPTURE(end.err);
  CHECK(end.code == 130);
  CHECK(end.out.find("lost provider mec") != end.out.npos);

  const auto lost = events_of(drive.out(), "provider_lost");
  const auto found = events_of(drive.out(), "provider_connected");
  REQUIRE(lost.size() == 1);
  REQUIRE(found.size() == 2);
  const auto lost_s = time_of(lost.front());
  const auto last = last_results(cycles_of(drive.out()), lost_s + turn_s);
  const auto times = remote_times(drive.out());
  REQUIRE(last.size() == vehicles);
  REQUIRE(times.size() == 2 * vehicles);
  for (std::size_t i = 0; i < vehicles; ++i) {
    CAPTURE(times[i].station);
    REQUIRE(times[i].end_s);
    CHECK(*times[i].end_s - last.at(times[i].station)
          <= longest_gap_s + turn_s);
  }

  // The new provider's clock begins when it does.
  (void)stop(provider->run());
  const auto in = events_of(provider->out(), "peer_connected");
  REQUIRE(in.size() == 1);
  const auto waited_s = time_of(in.front());
  for (std::size_t i = vehicles; i < times.size(); ++i)
    CHECK(waited_s + times[i].begin_s - time_of(found.back()) <= 3);
  check_safe(summary_of(drive.out()));
  check_one_source(drive.out());
  check_closed(provider->out(), "provider", vehicles, "shutdown");
}

TEST_CASE("a killed process of vehicles is forgotten, and others do not "
          "notice") {
  const workplace at;
  const auto settings = patient(6);
  provider_process provider{at, "provider", settings};
  drive_process doomed{at, "doomed", provider.port(),
                       settings + words{"--station", "101-103"}};
  drive_process others{at, "others", provider.port(),
                       settings + words{"--station", "104-106"}};
  REQUIRE(wait_for_offloaded(doomed, 3));
  REQUIRE(wait_for_offloaded(others, 3));
  const auto killed = monotonic::now();
  doomed.run().send(SIGKILL);
  doomed.run().wait();
  pass(2.5);
  CHECK(stop(others.run()).code == 130);
  CHECK(stop(provider.run()).code == 0);

  std::size_t freed = 0;
  for (const auto& r :
       episodes_of(provider.out(), "provider", "trajectory_planning")) {
    if (number(r, "station") > 103) {
      CHECK(r.at("reason") == "shutdown");
      continue;
    }
    ++freed;
    CHECK(r.at("reason") == "peer_lost");
    CHECK(number(r, "ended_s") - provider.earliest_s(killed) <= 2.2);
  }
  CHECK(freed == 3);

  const auto summary = summary_of(others.out());
  check_safe(summary);
  CHECK(summary["episodes"] == 3);
  CHECK(summary["fallbacks"] == 0);
  CHECK(events_of(others.out(), "violation").empty());
}

TEST_CASE("a provider that is stopped tells its vehicles, which drive on") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const workplace at;
    const auto settings = patient(3);
    provider_process provider{at, "provider", settings};
    drive_process drive{at, "drive", provider.port(), settings};
    REQUIRE(wait_for_offloaded(drive, 3));
    const auto end = stop(provider.run(), signal);
    CAPTURE(end.err);
    CHECK(end.code == 0);
    CHECK(end.err == "");
    CHECK(summary_of(provider.out())["interrupted"] == false);
    check_closed(provider.out(), "provider", 3, "shutdown");

    pass(0.5);
    CHECK(drive.run().runs());
    CHECK(stop(drive.run()).code == 130);
    const auto summary = summary_of(drive.out());
    check_safe(summary);
    CHECK(summary["episodes"] == 3);
    CHECK(events_of(drive.out(), "provider_lost").size() == 1);
    for (const auto& x : remote_times(drive.out())) {
      const auto lost_s =
          time_of(events_of(drive.out(), "provider_lost").front());
      REQUIRE(x.end_s);
      CHECK(*x.end_s <= lost_s + turn_s);
    }
  }
}

TEST_CASE("vehicles that are stopped tell their provider") {
  for (const int signal : {SIGINT, SIGTERM}) {
    CAPTURE(signal);
    const workplace at;
    const auto settings = patient(3);
    provider_process provider{at, "provider", settings};
    drive_process drive{at, "drive", provider.port(), settings};
    REQUIRE(wait_for_offloaded(drive, 3));
    const auto end = stop(drive.run(), signal);
    CAPTURE(end.err);
    CHECK(end.code == 130);
    CHECK(end.err == "");
    const auto summary = summary_of(drive.out());
    CHECK(summary["interrupted"] == true);
    check_safe(summary);
    check_closed(drive.out(), "requester", 3, "shutdown");

    pass(0.2);
    CHECK(provider.run().runs());
    CHECK(stop(provider.run()).code == 0);
    check_closed(provider.out(), "provider", 3, "shutdown");
  }
}
