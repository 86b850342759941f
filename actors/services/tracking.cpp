// Tracking as a service, the first of a chain: from what a vehicle's sensors
// see to tracks of the others.
#include "actors/services/chain/chain_stage.hpp"
#include "actors/services/chain/tracking_sides.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <chrono>
#include <memory>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

messages::payload with_tracks(const messages::payload& input,
                              const messages::service_result& result) {
  const auto request = input.as<plan_request>();
  auto tracks = result.what.as<known_tracks>();
  if (!request || !tracks)
    return {};
  auto next = *request;
  next.found.tracks = std::move(tracks);
  next.found.tracks_by = result.session.provider;
  return messages::payload::of(std::move(next));
}

class tracking final : public service_type {
public:
  tracking() {
    // Ours: a look goes up every 100 ms, so one may be lost.
    options.limits = {100ms, 250ms, 300ms};
    options.period = 50ms;
    options.input_period = 100ms;
    options.per_input = true;
    options.compute = {.run_time_mean = 2ms,
                       .run_time_sd = 300us,
                       .run_time_max = 10ms,
                       .demand = {},
                       .input_octets = 139};
  }

  std::string_view name() const override { return "tracking"; }

  offloading::service in(const service_world& world) const override {
    const auto shared = std::make_shared<const planning_world>(
        world.streets, world.where, world.car, world.crossings_granted,
        world.eyes, planner_options{}, nullptr, world.rss, world.beside);
    const auto houses = std::make_shared<const planners::line_of_sight>(
        world.streets->map.buildings());
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [shared, houses](const auto&) {
                  return make_tracking_in_vehicle(shared, houses);
                },
            .at_provider =
                [shared](const auto& provider) {
                  return make_tracking_at_provider(shared, provider);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {spawn_chain_stage(where, with_tracks,
                              options.warm_standby > duration{0})};
  }
};

} // namespace

service_type_ptr service_tracking() {
  return std::make_shared<tracking>();
}

} // namespace sofof::actors
