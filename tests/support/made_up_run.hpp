// Records as a run would make them, with figures that are easy to check.
#pragma once

#include "messages/protocol/record.hpp"
#include "recording/run_info.hpp"

#include <chrono>
#include <cstdint>

namespace sofof::made_up {

using namespace std::chrono_literals;

inline constexpr auto planning = "trajectory_planning";
inline constexpr provider_id provider = 18'000'000'000'000'000'000u;

/// The run's second 0, which is not the clock's.
inline constexpr time_point start{5s};

inline time_point at(duration since_start) {
  return start + since_start;
}

inline recording::run_info run() {
  recording::run_info info;
  info.scenario = "made_up";
  info.version = "0.1.0";
  info.config_toml = "seed = 7\n";
  info.seed = 7;
  info.vehicles = 2;
  info.provider_names = {{provider, "mec"}};
  info.services = {planning, "environment"};
  info.start = start;
  info.energy.costs = {{{101, planning}, {0.5, 0.25, 0.125}},
                       {{102, planning}, {0.25, 0.25, 0.125}}};
  return info;
}

inline messages::session_id running(station_id station = 101,
                                    std::uint32_t counter = 1,
                                    messages::service_name kind = planning) {
  return {provider, station, kind, counter};
}

inline messages::event_record switched(const messages::session_id& id,
                                       bool remote, duration when) {
  return {at(when),
          messages::event_type::switched,
          id.station,
          id.provider,
          id.service,
          id.counter,
          remote ? "remote" : "local",
          remote};
}

inline messages::decision_record
decision(bool accepted, messages::service_name kind = planning) {
  return {at(1s), 101, kind, accepted};
}

inline messages::cycle_record result(const messages::session_id& id,
                                     std::uint64_t cycle, duration created,
                                     duration latency,
                                     std::optional<duration> interarrival) {
  return {id, cycle, at(created), at(created + latency), interarrival, true};
}

/// A requester's episode with first data.
inline messages::episode_record episode(const messages::session_id& id,
                                        duration from, duration to,
                                        messages::end_reason reason,
                                        bool fallback = false) {
  return {id,
          messages::side::requester,
          at(from - 100ms),
          at(from),
          true,
          at(to),
          reason,
          fallback};
}

/// The same for a service that never sent anything.
inline messages::episode_record without_data(const messages::session_id& id,
                                             duration from) {
  return {id,
          messages::side::requester,
          at(from),
          at(from),
          false,
          at(from + 1s),
          messages::end_reason::no_data,
          false};
}

/// Lets two vehicles drive for 100 s; `to` takes the records one by one.
/// Expect: 101 offloaded twice, 20 s and 5 s, and 102 from 90 s on; 101 stops
/// on its own and brakes hard twice.
template <class Sink>
void play(Sink& to) {
  to.on_record(messages::event_record{at(9s), messages::event_type::offer, 101,
                                      provider, "", 0, "trajectory_planning"});
  to.on_record(messages::event_record{at(19s), messages::event_type::offer, 102,
                                      provider, "", 0, "trajectory_planning"});
  for (const bool accepted : {true, false, true, true, true})
    to.on_record(decision(accepted));
  to.on_record(decision(true, "environment"));

  to.on_record(switched(running(101, 1), true, 10s));
  std::optional<duration> gap; // none before the first
  for (int i = 0; i < 400; ++i, gap = 50ms)
    to.on_record(result(running(101, 1), 200 + static_cast<std::uint64_t>(i),
                        10s + i * 50ms, 8ms + (i % 5) * 1ms, gap));
  to.on_record(switched(running(101, 1), false, 30s));
  to.on_record(
      episode(running(101, 1), 10s, 30s, messages::end_reason::left_area));
  to.on_record(messages::episode_record{
      running(101, 1), messages::side::provider, at(9s), at(9s), true, at(30s),
      messages::end_reason::left_area, false, "x_m=1 y_m=2"});

  to.on_record(switched(running(101, 2), true, 60s));
  to.on_record(result(running(101, 2), 1200, 60s, 12'345'678ns, std::nullopt));
  to.on_record(switched(running(101, 2), false, 65s));
  to.on_record(
      episode(running(101, 2), 60s, 65s, messages::end_reason::qos_gap, true));

  to.on_record(without_data(running(102, 3), 40s));
  to.on_record(switched(running(102, 4), true, 90s));
  to.on_record(messages::safety_record{101, 100s, 0s, 0s, 150ms});
  to.on_record(messages::safety_record{102, 100s, 0s, 0s, 180ms});
  to.on_record(messages::drive_record{101,
                                      {2000, 3, 4, 2, 6, 1, {1.5, 1.25, -2}},
                                      {900, {1.75, 1.5, -4}, 2, 80}});
  to.on_record(messages::drive_record{102,
                                      {1000, 0, 1, 0, 1, 0, {2, 1, -2.5}},
                                      {800.5, {1, 2, -2.5}, 0, 20.5}});
  to.on_record(messages::trip_record{101, {100, 90, 2, 12.5, false}});
  to.on_record(messages::trip_record{102, {100, 99.25, 0, 0, true}});
  to.on_record(messages::work_record{101, planning, 1600, 0});
  to.on_record(messages::work_record{102, planning, 1000, 0});
  to.on_record(messages::plan_switch_record{
      at(10s), running(101, 1), true, {0.25, 0.001, 0.5, 1}});
  to.on_record(messages::plan_switch_record{
      at(30s), running(101, 1), false, {0.75, 0.002, 0.25, 0}});
}

} // namespace sofof::made_up
