// What a vehicle has of a service at any time, whoever runs it.
#include "actors/offloading/onboard_service.hpp"

#include "actors/offloading/service_manager.hpp"
#include "base/protocol.hpp"
#include "base/random_phase.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace sofof {

namespace {

std::function<time_point(time_point, std::uint64_t)>
local_run_time(bool virtual_time, const service_options& options,
               const random_stream& noise) {
  if (!virtual_time)
    return [](time_point start, std::uint64_t) { return start; };
  return [options, draws = noise.part("local run time")](time_point start,
                                                         std::uint64_t cycle) {
    const auto drawn =
        from_seconds(draws.normal(to_seconds(options.run_time_mean),
                                  to_seconds(options.run_time_sd), cycle));
    return start + std::clamp(drawn, duration{0}, options.run_time_max);
  };
}

offloading::cycle_setup local_cycle(const requester_setup& vehicle,
                                    const service_type& kind,
                                    const service_setup& here) {
  offloading::cycle_setup local;
  local.function = kind.make_function(here);
  local.period = kind.common.period;
  local.phase = random_phase(here.noise.part("local phase"), local.period);
  local.finish = local_run_time(vehicle.virtual_time,
                                on(vehicle.computer, kind.common), here.noise);
  return local;
}

} // namespace

service_setup onboard_setup(const requester_setup& vehicle,
                            const service_type& kind,
                            std::function<time_point()> clock) {
  return {.world = vehicle.world,
          .where = vehicle.where,
          .station = vehicle.station,
          .noise = vehicle.noise.part(kind.name()),
          .crossings_granted = vehicle.crossings_granted,
          .clock = std::move(clock)};
}

offloading::requested_service requested(const requester_setup& vehicle,
                                        const service_type_ptr& kind,
                                        const service_setup& here) {
  // A provider tells itself how long it computes.
  constexpr auto in_no_time = std::numeric_limits<double>::infinity();
  const auto& common = kind->common;
  return {.name = kind->name(),
          .needs = {common.period, common.limits.max_latency,
                    common.limits.max_interarrival},
          .demand = common.demand,
          .on_board = on_board_cost(vehicle.computer, common.task),
          .offloaded =
              offloaded_cost(vehicle.computer, common.task, in_no_time),
          .termination_message = [kind, here](const service_end& end,
                                              time_point t, const cam& own) {
            return kind->termination_message(here, end, t, &own);
          }};
}

onboard_service spawn_onboard_service(caf::actor_system& sys,
                                      const requester_setup& vehicle,
                                      const service_type_ptr& kind,
                                      onboard_requester_actor requester,
                                      const service_setup& here) {
  auto local = local_cycle(vehicle, *kind, here);
  auto client = kind->spawn_client(sys, here, vehicle.vehicle);
  auto manager = spawn_requester_manager(
      sys,
      {vehicle.station, kind->name(), kind->common,
       [kind, here](service_input input, bool takes_over) {
         return kind->on_air(here, std::move(input), takes_over);
       },
       [kind, here] { return kind->make_judge(here); },
       [kind](const payload& in_use, const payload& offered, time_point now) {
         return kind->continues(in_use, offered, now);
       },
       std::move(local), client, std::move(requester), vehicle.recorder,
       vehicle.record_margins});
  return {std::move(client), std::move(manager)};
}

offloading::requester_setup
rules_of(requester_setup vehicle,
         std::vector<offloading::requested_service> services) {
  return {.station = vehicle.station,
          .services = std::move(services),
          .policy = std::move(vehicle.lodm),
          .noise = vehicle.noise,
          .path_ahead =
              [way = vehicle.way](const ego_state& ego) {
                return way->waypoints(ego.s_m, protocol::route_ahead_m,
                                      protocol::route_spacing_m);
              },
          .future = std::move(vehicle.future)};
}

} // namespace sofof
