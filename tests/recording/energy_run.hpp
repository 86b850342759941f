// Two vehicles with a chain of two services and a third one, at known powers.
#pragma once

#include "recording/energy_table.hpp"
#include "recording/split_ledger.hpp"
#include "tests/support/made_up_run.hpp"

namespace sofof::made_up {

/// A cycle takes 10 ms of a period of 100 ms, and 1 J on a computer of 100 W.
inline recording::run_info run_with_chain() {
  auto info = run();
  info.services = {"look", "plan", "warm"};
  info.energy = {};
  for (const station_id station : {101u, 102u}) {
    info.energy.vehicles[station] = {100, 0.25, 1e-3, 5e-4};
    for (const auto* service : {"look", "plan", "warm"})
      info.energy.costs[{station, service}] = {
          .result_j = 0.125, .run_time = 10ms, .period = 100ms};
  }
  info.energy.servers["mec"] = {3, 1};
  info.energy.chains = {{"look", "plan"}, {"warm"}};
  return info;
}

/// What a vehicle's function and its messages were in [from, to).
inline messages::work_record work(station_id station, const char* service,
                                  duration from, duration to,
                                  std::uint64_t computed,
                                  std::uint64_t octets_up = 0,
                                  std::uint64_t octets_down = 0) {
  messages::work_record x{station, service};
  x.computed = computed;
  x.computing = computed * 10ms;
  x.octets_up = octets_up;
  x.octets_down = octets_down;
  x.since = at(from);
  x.at = at(to);
  return x;
}

/// A second of driving at 10 m/s, as vehicles tell it.
template <class Sink>
void drive_on(Sink& to, station_id station) {
  to.add(messages::safety_record{station, 1s, 0s, 0s, 0s});
  messages::drive_record driven{station, {}, {}};
  driven.ride.distance_m = 10;
  to.add(driven);
}

/// A result that a provider computed for so long.
inline messages::cycle_record served(station_id station, const char* service,
                                     duration computing) {
  auto x = result(running(station, 1, service), 1, 0s, 20ms, {});
  x.timing.computing = computing;
  return x;
}

} // namespace sofof::made_up
