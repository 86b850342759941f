// What one cycle of a function costs a vehicle: on board, and offloaded.
#include "world/vehicle/cycle_cost.hpp"

#include "base/options/option_helpers.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace sofof::world {

namespace {

/// No normal draw is so many deviations from its mean: none has more than 52
/// bits to be rare by (base/random.cpp), which are 8.572.
constexpr double beyond_draws = 8.6;
constexpr double giga = 1e9;
constexpr double bits_per_octet = 8;

// Two numbers stood for what run_time_mean and input_octets say alone.
void refuse_former(option_visitor& s, std::string_view key,
                   const std::string& instead) {
  if (s.has(key, false))
    s.refuse(key, instead);
}

constexpr std::string_view alone = "none";
constexpr std::array<std::string_view, 3> schedulings{alone, "fixed_priority",
                                                      "edf"};

void visit_scheduling(option_visitor& s, std::optional<core_order>& order) {
  std::string word{!order                      ? alone
                   : *order == core_order::edf ? schedulings[2]
                                               : schedulings[1]};
  visit_word(s, "scheduling", word, "scheduling", schedulings);
  order = word == alone            ? std::nullopt
          : word == schedulings[2] ? std::optional{core_order::edf}
                                   : core_order::fixed_priority;
}

} // namespace

void computer_options::visit_options(option_visitor& s) {
  s.field("clock_ghz", clock_ghz, {0.1, 100});
  s.field("capacitance_js2", capacitance_js2, {0, 1e-20});
  s.field("transmit_power_w", transmit_power_w, {0, 100});
  s.field("uplink_mbps", uplink_mbps, {0.001, 1e6});
  if (s.has("computing_w", computing_w.has_value()))
    s.field("computing_w", computing_w ? *computing_w : computing_w.emplace(),
            {0, 1e4});
  s.field("resting_share", resting_share, {0, 1});
  s.field("receiving_share", receiving_share, {0, 1e3});
  if (s.has("scheduling", scheduling.has_value()))
    visit_scheduling(s, scheduling);
  if (!scheduling) {
    for (const auto key : {"cores", "strict"})
      if (s.has(key, false))
        s.refuse(key, "has no effect without scheduling.");
    return;
  }
  s.field("cores", cores, {1, 1024});
  s.field("strict", strict);
}

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

duration longest_run_time(const cycle_options& cycle) {
  return std::min(
      cycle.run_time_max,
      cycle.run_time_mean
          + from_seconds(beyond_draws * to_seconds(cycle.run_time_sd)));
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
