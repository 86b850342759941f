// What one cycle of a function costs a vehicle: on board, and offloaded.
#include "world/vehicle/cycle_cost.hpp"

#include <string>
#include <string_view>

namespace sofof::world {

namespace {

constexpr double giga = 1e9;
constexpr double bits_per_octet = 8;

// Two numbers stood for what run_time_mean and input_octets say alone.
void refuse_former(option_visitor& s, std::string_view key,
                   const std::string& instead) {
  double former = 0;
  if (!s.has(key, false))
    return;
  s.field(key, former);
  s.refuse(key, instead);
}

} // namespace

void cycle_options::visit_options(option_visitor& s) {
  s.field("run_time_mean", run_time_mean, duration{0});
  s.field("run_time_sd", run_time_sd, duration{0});
  s.field("run_time_max", run_time_max, duration{0});
  if (s.has("demand", demand.has_value()))
    s.field("demand", demand ? *demand : demand.emplace(), {0, 1e3});
  s.field("input_octets", input_octets, {0, 1e7});
  s.field("overhead_j", overhead_j, {0, 1e3});
  refuse_former(s, "gigacycles",
                "is no more; run_time_mean says it, at 3 GHz.");
  refuse_former(s, "input_kbit",
                "is no more; say input_octets, 125 to the kbit.");
}

double demand_of(const cycle_options& cycle) {
  return cycle.demand.value_or(to_seconds(cycle.run_time_mean)
                               / to_seconds(usual_run_time));
}

double computing_power_w(const computer_options& computer) {
  const auto clock_hz = computer.clock_ghz * giga;
  return computer.computing_w.value_or(computer.capacitance_js2 * clock_hz
                                       * clock_hz * clock_hz);
}

cycle_cost on_board_cost(const computer_options& computer,
                         const cycle_options& cycle) {
  const auto clock_hz = computer.clock_ghz * giga;
  const auto cycles = to_seconds(cycle.run_time_mean) * usual_clock_ghz * giga;
  const auto time_s = cycles / clock_hz;
  return {time_s, computer.computing_w ? *computer.computing_w * time_s
                                       : computer.capacitance_js2 * clock_hz
                                             * clock_hz * cycles};
}

cycle_cost sending_cost(const computer_options& computer,
                        const cycle_options& cycle) {
  constexpr double mega = 1e6;
  const auto bits = bits_per_octet * static_cast<double>(cycle.input_octets);
  const auto sending_s = bits / (computer.uplink_mbps * mega);
  return {sending_s, computer.transmit_power_w * sending_s};
}

} // namespace sofof::world
