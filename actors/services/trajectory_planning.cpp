// Trajectory planning as a service: the vehicle is its client; the planner at
// a provider may plan farther and more thoroughly than the vehicle's own.
#include "actors/services/planning/planning_sides.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <chrono>
#include <memory>
#include <string_view>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// Ours: inputs come every 100 ms, so that two in a row may get lost on a way
/// up that takes as long as the limit of latency.
constexpr auto default_input_age = 500ms;

class trajectory_planning final : public service_type {
public:
  trajectory_planning() {
    // Limits: Dehler & Buchholz 2025, but for the age. Run time: its table
    // "CPU", simulation column, (19.5 % - 8.5 %) / 20 Hz.
    options.limits = {50ms, 100ms, default_input_age};
    options.period = 50ms;
    options.input_period = 100ms;
    options.compute = {.run_time_mean = world::usual_run_time,
                       .run_time_sd = 2ms,
                       .run_time_max = 45ms,
                       .demand = {},
                       .input_octets = 185}; // an MCM on the air, measured
  }

  std::string_view name() const override { return "trajectory_planning"; }

  std::string_view follows() const override { return "environment_model"; }

  void visit_options(option_visitor& s) override {
    service_type::visit_options(s);
    s.table("planner",
            [this](option_visitor& t) { planner_.visit_options(t); });
    s.table("rss", [this](option_visitor& t) {
      rss_.visit_options(t);
      t.field("proper_response", proper_response_, duration{0});
    });
  }

  offloading::service in(const service_world& world) const override {
    auto roads = std::make_shared<known_roads>(
        world.streets->map, planner_.style,
        planners::eyes_on_road{world.eyes.range_m, world.eyes.field_of_view_deg,
                               world.eyes.occlusion, world.roadside},
        !world.crossings_granted);
    auto shared = std::make_shared<const planning_world>(
        world.streets, world.where, world.car, world.crossings_granted,
        world.eyes, planner_, std::move(roads), rss_, world.beside,
        proper_response_);
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [shared](const auto& vehicle) {
                  return make_planning_in_vehicle(shared, vehicle);
                },
            .at_provider =
                [shared](const auto& provider) {
                  return make_planning_at_provider(shared, provider);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {where.vehicle};
  }

  std::shared_ptr<const plan_client> plans() const override {
    return make_plan_client();
  }

  planners::rss_assumptions assumed() const override { return rss_; }

private:
  planner_options planner_;
  planners::rss_assumptions rss_;
  duration proper_response_{};
};

} // namespace

service_type_ptr service_trajectory_planning() {
  return std::make_shared<trajectory_planning>();
}

} // namespace sofof::actors
