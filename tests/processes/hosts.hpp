// Providers and vehicles as processes of their own, on this machine, and what
// they wrote down of each other.
#pragma once

#include "tests/processes/results_reader.hpp"
#include "tests/processes/workplace.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test {

using monotonic = std::chrono::steady_clock;
using words = std::vector<std::string>;

inline constexpr double longest_gap_s = 0.1; // of trajectory_planning
inline constexpr double turn_s = 0.05;       // from the end of it to the switch

inline double seconds(monotonic::duration d) {
  return std::chrono::duration<double>{d}.count();
}

inline void pass(double time_s) {
  std::this_thread::sleep_for(std::chrono::duration<double>{time_s});
}

inline words operator+(words first, const words& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// Settings of a scenario with so many vehicles all round the map, each of
/// which is offloaded at once and for as long as there is a provider.
inline words everywhere(int vehicles) {
  words all;
  for (const auto& setting :
       {"fleet.0.count=" + std::to_string(vehicles),
        std::string{"provider.mec.area_radius_m=3000"},
        std::string{"provider.mec.range_m=6000"},
        std::string{"policies.lodm=always"},
        std::string{"policies.codm=always"},
        std::string{"service.trajectory_planning.planner=lane_follow"}}) {
    all.emplace_back("--set");
    all.push_back(setting);
  }
  return all;
}

/// The same with limits that a machine which stands still for a moment does not
/// break: where nobody shall fall back.
inline words patient(int vehicles) {
  return everywhere(vehicles)
         + words{"--set", "service.trajectory_planning.max_latency=200ms",
                 "--set", "service.trajectory_planning.max_interarrival=200ms"};
}

/// `sofof keys` with these words.
inline void do_keys(const workplace& at, words more) {
  more.insert(more.begin(), "keys");
  const auto end = at.run_sofof(more);
  CAPTURE(end.err);
  REQUIRE(end.code == 0);
}

/// A provider that runs.
class provider_process {
public:
  /// Returns when it listens; the test ends when it does not.
  /// @param port  0: any.
  provider_process(const workplace& at, const std::string& out,
                   const words& more, std::uint16_t port = 0)
      : out_{at / out}, run_{words{"provide", scenario_file, "--quiet",
                                   "--listen",
                                   "127.0.0.1:" + std::to_string(port), "--out",
                                   out}
                                 + more,
                             at.here()} {
    static constexpr std::string_view before = "listens on 127.0.0.1:";
    REQUIRE(wait_until([this] {
      return !run_.runs() || run_.printed().find('\n') != std::string::npos;
    }));
    listens_ = monotonic::now();
    const auto text = run_.printed();
    const auto found = text.find(before);
    if (found == text.npos)
      FAIL("no provider: ", run_.wait().err);
    port_ = static_cast<std::uint16_t>(
        std::stoi(text.substr(found + before.size())));
  }

  std::uint16_t port() const { return port_; }
  const std::filesystem::path& out() const { return out_; }
  program& run() { return run_; }

  /// @returns a time on its own clock, or a moment later.
  double latest_s(monotonic::time_point t) const {
    return seconds(t - started_);
  }
  /// @returns the same, or a moment earlier.
  double earliest_s(monotonic::time_point t) const {
    return seconds(t - listens_);
  }

private:
  monotonic::time_point started_ = monotonic::now();
  monotonic::time_point listens_;
  std::uint16_t port_ = 0;
  std::filesystem::path out_;
  program run_;
};

inline words drive_words(const std::string& out, std::uint16_t port,
                         const words& more) {
  return words{"drive",
               scenario_file,
               "--quiet",
               "--out",
               out,
               "--provider",
               "127.0.0.1:" + std::to_string(port)}
         + more;
}

/// Vehicles that drive.
class drive_process {
public:
  drive_process(const workplace& at, const std::string& out, std::uint16_t port,
                const words& more)
      : drive_process{at, out, drive_words(out, port, more)} {}
  /// @param all  Of the command.
  drive_process(const workplace& at, const std::string& out, const words& all)
      : out_{at / out}, run_{all, at.here()} {}

  const std::filesystem::path& out() const { return out_; }
  program& run() { return run_; }

private:
  std::filesystem::path out_;
  program run_;
};

/// Ends a process in good order.
inline ending stop(program& run, int signal = SIGTERM) {
  run.send(signal);
  return run.wait();
}

// -- what happened ----------------------------------------------------------

using event = nlohmann::json;

/// @returns when it happened, on the clock of who wrote it down.
inline double time_of(const event& e) {
  return e["t_s"].get<double>();
}

/// @returns the whole lines of events.jsonl so far.
inline std::vector<event> events_of(const std::filesystem::path& folder) {
  auto text = read_file(folder / "events.jsonl");
  text.resize(text.rfind('\n') + 1);
  std::istringstream in{text};
  std::vector<event> all;
  for (std::string line; std::getline(in, line);)
    all.push_back(nlohmann::json::parse(line));
  return all;
}

inline std::vector<event> events_of(const std::filesystem::path& folder,
                                    const std::string& what) {
  auto all = events_of(folder);
  std::erase_if(all, [&](const event& e) { return e["what"] != what; });
  return all;
}

/// A time in which trajectories for a vehicle came from a provider.
struct remote_time {
  std::uint32_t station = 0;
  std::string service; ///< As `service_of` names it.
  double begin_s = 0;
  std::optional<double> end_s; ///< Nothing while it lasts.
};

/// @returns what names a running service of a vehicle: its provider, its
/// number.
inline std::string service_of(const row& r) {
  return r.at("provider_id") + "/" + r.at("counter");
}
inline std::string service_of(const event& e) {
  return std::to_string(e["provider_id"].get<std::uint64_t>()) + "/"
         + std::to_string(e["counter"].get<std::uint64_t>());
}

/// @returns all of them, in the order in which they began.
inline std::vector<remote_time>
remote_times(const std::filesystem::path& folder) {
  std::vector<remote_time> all;
  for (const auto& e : events_of(folder, "switch")) {
    if (e["service"] != "trajectory_planning")
      continue;
    const std::uint32_t station = e["station"];
    const auto t_s = time_of(e);
    if (e["detail"] == "remote") {
      all.push_back({station, service_of(e), t_s, {}});
      continue;
    }
    for (auto& x : all)
      if (x.station == station && !x.end_s)
        x.end_s = t_s;
  }
  return all;
}

/// @returns how many vehicles are planned for by a provider now, as far as it
/// is written down: up to two seconds late.
inline std::size_t offloaded(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::ranges::count_if(
      remote_times(folder), [](const auto& x) { return !x.end_s; }));
}

/// @returns whether so many are, before the test loses its patience.
inline bool wait_for_offloaded(drive_process& drive, std::size_t vehicles) {
  return wait_until([&] {
           return !drive.run().runs() || offloaded(drive.out()) >= vehicles;
         })
         && drive.run().runs();
}

/// @returns the remote results of trajectory planning, in the order received.
inline std::vector<row> cycles_of(const std::filesystem::path& folder) {
  auto rows = rows_of(folder / "cycles.csv");
  std::erase_if(rows, [](const row& r) {
    return r.at("service") != "trajectory_planning";
  });
  return rows;
}

/// Whatever became of the connection, this holds for every vehicle.
inline void check_safe(const nlohmann::json& summary) {
  CHECK(summary["safety"]["collisions"] == 0);
  CHECK(summary["safety"]["off_road_s"] == 0.0);
  CHECK(summary["safety"]["without_fresh_plan_s"] == 0.0);
  CHECK(summary["safety"]["max_plan_age_s"] <= 0.25);
  CHECK(summary["running_at_end"] == 0);
}

/// A vehicle uses a remote result only while its source is remote, and only
/// of the service that it has switched to.
inline void check_one_source(const std::filesystem::path& folder) {
  const auto times = remote_times(folder);
  for (const auto& r : cycles_of(folder)) {
    if (r.at("used") != "1")
      continue;
    const auto received_s = number(r, "received_s");
    const auto of = std::ranges::find_if(times, [&](const auto& x) {
      constexpr double noted_s = 0.1; // by two actors: either may wait
      return std::to_string(x.station) == r.at("station")
             && x.service == service_of(r) && x.begin_s <= received_s + noted_s
             && received_s <= x.end_s.value_or(received_s) + noted_s;
    });
    CAPTURE(r.at("station"));
    CAPTURE(received_s);
    REQUIRE(of != times.end());
  }
  for (auto a = times.begin(); a != times.end(); ++a)
    for (auto b = a + 1; b != times.end(); ++b)
      if (a->station == b->station)
        CHECK(a->end_s.value_or(b->begin_s + 1) <= b->begin_s);
}

} // namespace sofof::test
