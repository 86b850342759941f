// What one cycle of a function costs a vehicle: on board, and offloaded.
#include "world/vehicle/cycle_cost.hpp"

namespace sofof::world {

namespace {

constexpr double giga = 1e9;

} // namespace

cycle_cost on_board_cost(const computer_options& computer,
                         const cycle_options& cycle) {
  const auto clock_hz = computer.clock_ghz * giga;
  return {cycle.gigacycles / computer.clock_ghz, computer.capacitance_js2
                                                     * clock_hz * clock_hz
                                                     * cycle.gigacycles * giga};
}

cycle_cost offloaded_cost(const computer_options& computer,
                          const cycle_options& cycle, double provider_ghz) {
  const auto sending_s = 1e-3 * cycle.input_kbit / computer.uplink_mbps;
  return {sending_s + cycle.gigacycles / provider_ghz,
          computer.transmit_power_w * sending_s + cycle.overhead_j};
}

} // namespace sofof::world
