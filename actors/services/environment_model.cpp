// An environment model as a service, the second of a chain: from tracks, the
// map and what others tell of their drives to the scene on a vehicle's own way.
#include "actors/services/chain/chain_stage.hpp"
#include "actors/services/chain/environment_sides.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <chrono>
#include <memory>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

messages::payload with_scene(const messages::payload& input,
                             const messages::service_result& result) {
  const auto request = input.as<plan_request>();
  auto scene = result.what.as<known_scene>();
  if (!request || !scene)
    return {};
  auto next = *request;
  next.found.scene = std::move(scene);
  next.found.scene_by = result.session.provider;
  return messages::payload::of(std::move(next));
}

class environment_model final : public service_type {
public:
  environment_model() {
    // Ours, as those of tracking. An input is sent for all tracks, which come
    // every 50 ms, more or less.
    options.limits = {100ms, 250ms, 300ms};
    options.period = 50ms;
    options.input_period = 10ms;
    options.per_input = true;
    options.compute = {.run_time_mean = 3ms,
                       .run_time_sd = 500us,
                       .run_time_max = 15ms,
                       .demand = {},
                       .input_octets = 196};
  }

  std::string_view name() const override { return "environment_model"; }

  std::string_view follows() const override { return "tracking"; }

  offloading::service in(const service_world& world) const override {
    const planners::eyes_on_road eyes{world.eyes.range_m,
                                      world.eyes.field_of_view_deg,
                                      world.eyes.occlusion, world.roadside};
    const auto shared = std::make_shared<const planning_world>(
        world.streets, world.where, world.car, world.crossings_granted,
        world.eyes, planner_options{},
        std::make_shared<known_roads>(world.streets->map,
                                      planners::comfort_limits{}, eyes,
                                      !world.crossings_granted),
        planners::rss_assumptions{}, world.beside);
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [shared](const auto& vehicle) {
                  return make_environment_in_vehicle(shared, vehicle);
                },
            .at_provider =
                [shared](const auto& provider) {
                  return make_environment_at_provider(shared, provider);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {spawn_chain_stage(where, with_scene,
                              options.warm_standby > duration{0})};
  }
};

} // namespace

service_type_ptr service_environment_model() {
  return std::make_shared<environment_model>();
}

} // namespace sofof::actors
