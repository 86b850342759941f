// What a scenario lets a vehicle promise itself: how long its own functions
// take at most when all of them are at home.
#pragma once

#include "channel/preemptive_core.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sofof::scenario {

/// A function on the cores that all functions of a vehicle share.
struct function_response {
  std::string service;
  std::size_t core = 0;
  std::size_t number = 0; ///< On its core, the most urgent first.
  duration limit{};       ///< Its period: then no cycle delays the next one.
  /// From a cycle's start to its result, whenever each function begins;
  /// nullopt if there is no bound.
  std::optional<duration> at_most;

  bool is_in_time() const { return at_most && *at_most <= limit; }
};

/// The functions of a fleet's vehicles.
struct vehicle_schedule {
  std::int64_t first_station = 0;
  std::int64_t vehicles = 1;
  core_order order = core_order::fixed_priority;
  std::vector<double> loads; ///< Of each core, by longest run times.
  std::vector<function_response> functions; ///< In the scenario's order.
};

/// @param fleet  Its place.
/// @returns nullopt if functions of its vehicles share nothing.
std::optional<vehicle_schedule> schedule_at_home(const scenario_definition& all,
                                                 std::size_t fleet);

/// @returns where the functions of one more vehicle run, in the scenario's
/// order.
std::vector<channel::core_seat> seats_of(const vehicle_schedule& schedule);

/// @returns what is stated of it, as comments of a scenario file.
std::string to_comment(const vehicle_schedule& schedule);

/// @returns in a sentence why its vehicles cannot take all their functions
/// back; empty if they can.
std::string warning_of(const vehicle_schedule& schedule);

} // namespace sofof::scenario
