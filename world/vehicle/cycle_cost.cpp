// What one cycle of a function costs a vehicle: on board, and offloaded.
#include "world/vehicle/cycle_cost.hpp"

namespace sofof {

namespace {

constexpr option_visitor::range clocks_ghz{0.1, 100};
constexpr option_visitor::range capacitances_js2{0, 1e-20};
constexpr option_visitor::range powers_w{0, 100};
constexpr option_visitor::range rates_mbps{0.001, 1e6};
constexpr option_visitor::range any_gigacycles{0, 1e3};
constexpr option_visitor::range any_kbit{0, 1e6};
constexpr option_visitor::range any_energy_j{0, 1e3};

constexpr double giga = 1e9;

} // namespace

void computer_options::visit_options(option_visitor& s) {
  s.field("clock_ghz", clock_ghz, clocks_ghz);
  s.field("capacitance_js2", capacitance_js2, capacitances_js2);
  s.field("transmit_power_w", transmit_power_w, powers_w);
  s.field("uplink_mbps", uplink_mbps, rates_mbps);
}

void task_options::visit_options(option_visitor& s) {
  s.field("gigacycles", gigacycles, any_gigacycles);
  s.field("input_kbit", input_kbit, any_kbit);
  s.field("overhead_j", overhead_j, any_energy_j);
}

cycle_cost on_board_cost(const computer_options& computer,
                         const task_options& task) {
  const auto clock_hz = computer.clock_ghz * giga;
  return {task.gigacycles / computer.clock_ghz, computer.capacitance_js2
                                                    * clock_hz * clock_hz
                                                    * task.gigacycles * giga};
}

cycle_cost offloaded_cost(const computer_options& computer,
                          const task_options& task, double provider_ghz) {
  const auto sending_s = 1e-3 * task.input_kbit / computer.uplink_mbps;
  return {sending_s + task.gigacycles / provider_ghz,
          computer.transmit_power_w * sending_s + task.overhead_j};
}

} // namespace sofof
