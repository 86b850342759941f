// The actors of one service in a vehicle, and what the rules know of it.
#include "actors/offloading/service_actors.hpp"

#include "actors/offloading/service_manager.hpp"
#include "base/random_phase.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace sofof {

namespace {

std::function<time_point(time_point, std::uint64_t)>
local_run_time(bool virtual_time, const offloading::service_options& options,
               const random_stream& noise) {
  if (!virtual_time)
    return [](time_point start, std::uint64_t) { return start; };
  return [compute = options.compute, draws = noise.part("local run time")](
             time_point start, std::uint64_t cycle) {
    const auto drawn =
        from_seconds(draws.normal(to_seconds(compute.run_time_mean),
                                  to_seconds(compute.run_time_sd), cycle));
    return start + std::clamp(drawn, duration{0}, compute.run_time_max);
  };
}

offloading::cycle_setup local_cycle(const requester_setup& vehicle,
                                    const offloading::service& what,
                                    offloading::vehicle_service& own) {
  const auto noise = vehicle.noise.part(what.name.view());
  offloading::cycle_setup local;
  local.function = own.make_function();
  local.period = what.options.period;
  local.phase = random_phase(noise.part("local phase"), local.period);
  local.finish = local_run_time(vehicle.virtual_time,
                                on(vehicle.computer, what.options), noise);
  return local;
}

} // namespace

service_actors
spawn_service_actors(caf::actor_system& sys, const requester_setup& vehicle,
                     const client_service& what,
                     const std::shared_ptr<offloading::vehicle_service>& own,
                     onboard_requester_actor requester) {
  auto local = local_cycle(vehicle, what.service, *own);
  auto client = what.spawn_client(sys, vehicle.vehicle);
  auto manager = spawn_requester_manager(
      sys, {vehicle.station, what.service.name, what.service.options, own,
            std::move(local), client, std::move(requester), vehicle.recorder,
            vehicle.record_margins});
  return {std::move(client), std::move(manager)};
}

offloading::requested_service
requested(const requester_setup& vehicle, const offloading::service& what,
          std::shared_ptr<offloading::vehicle_service> own) {
  // A provider tells itself how long it computes.
  constexpr auto in_no_time = std::numeric_limits<double>::infinity();
  const auto& options = what.options;
  return {.name = what.name,
          .needs = {options.period, options.limits.max_latency,
                    options.limits.max_interarrival},
          .demand = options.compute.demand,
          .on_board = on_board_cost(vehicle.computer, options.compute),
          .offloaded =
              offloaded_cost(vehicle.computer, options.compute, in_no_time),
          .termination_message = [own = std::move(own)](const service_end& end,
                                                        time_point t,
                                                        const cam& motion) {
            return own->termination_message(end, t, motion);
          }};
}

offloading::requester_setup
rules_of(requester_setup vehicle,
         std::vector<offloading::requested_service> services) {
  return {.station = vehicle.station,
          .services = std::move(services),
          .policy = std::move(vehicle.lodm),
          .noise = vehicle.noise,
          .path_ahead = std::move(vehicle.path_ahead),
          .future = std::move(vehicle.future)};
}

} // namespace sofof
