// What services do unless they say otherwise, and the options they share.
#include "offloading/service.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace sofof::offloading {

namespace {

/// @returns the longest time from the start of a cycle on board to its result.
duration longest_cycle(const service_options& options) {
  return options.shared_response.value_or(options.compute.run_time_max);
}

} // namespace

service_options on(const world::computer_options& computer,
                   service_options options) {
  assert(computer.clock_ghz > 0);
  assert(options.period >= duration{0});
  if (computer.clock_ghz == world::usual_clock_ghz)
    return options;
  const auto slower = world::usual_clock_ghz / computer.clock_ghz;
  const auto scaled = [slower](duration d) {
    return from_seconds(slower * to_seconds(d));
  };
  auto& cycle = options.compute;
  cycle.demand = world::demand_of(cycle); // a provider's clock is another
  cycle.run_time_mean = scaled(cycle.run_time_mean);
  cycle.run_time_sd = scaled(cycle.run_time_sd);
  const auto longest = std::max(cycle.run_time_max, options.period);
  cycle.run_time_max = std::min(scaled(cycle.run_time_max), longest);
  return options;
}

world::cycle_cost offloaded_cost(const world::computer_options& computer,
                                 const service_options& options) {
  assert(options.period > duration{0});
  const auto input = world::sending_cost(computer, options.compute);
  const auto inputs_per_cycle =
      options.per_input
          ? 1
          : to_seconds(options.period)
                / to_seconds(std::max(options.period, options.input_period));
  return {input.time_s,
          inputs_per_cycle * input.energy_j + options.compute.overhead_j};
}

duration worst_response(const service_options& options) {
  const auto& limits = options.limits;
  const auto own = longest_cycle(options);
  if (limits.max_input_age == duration::max() || own == duration::max())
    return duration::max();
  assert(limits.max_input_age > duration{0});
  return limits.max_input_age + limits.max_interarrival + own;
}

duration own_response(const service_options& options) {
  const auto own = longest_cycle(options);
  return own == duration::max() || options.per_input ? own
                                                     : options.period + own;
}

std::optional<messages::qos_limits>
limits_in_scene(const service_options& options, duration safe) {
  auto limits = options.limits;
  const auto own = longest_cycle(options);
  if (own == duration::max())
    return std::nullopt;
  const auto left = safe - limits.max_interarrival - own;
  if (left < options.latency_floor)
    return std::nullopt;
  limits.max_latency = std::min(limits.max_latency, left);
  limits.max_input_age = std::min(limits.max_input_age, left);
  assert(limits.max_latency > duration{0});
  return limits;
}

messages::service_input
vehicle_service::encode_input(messages::service_input input,
                              bool takes_over) const {
  if (!takes_over)
    input.in_use = {};
  return input;
}

bool vehicle_service::continues(const messages::payload&,
                                const messages::payload&, time_point) const {
  return true;
}

std::unique_ptr<result_judge> vehicle_service::make_judge() const {
  return believe_all();
}

std::optional<safe_response>
vehicle_service::look_at_scene(const messages::service_input&) const {
  return std::nullopt;
}

messages::payload
vehicle_service::termination_message(const messages::service_end&, time_point,
                                     const messages::cam&) const {
  return {};
}

std::string_view provider_service::objection(std::span<const point>) const {
  return {};
}

messages::payload
provider_service::termination_message(const messages::service_end&,
                                      time_point) {
  return {};
}

onboard_service in_vehicle(const service& what, const vehicle_context& where) {
  return {what.name, what.options, what.in_vehicle(where), what.follows};
}

offered_service at_provider(const service& what,
                            const provider_context& where) {
  return {what.name, what.options, what.at_provider(where), what.follows};
}

} // namespace sofof::offloading
