// Crossing management as a service: a provider plans how all vehicles go over
// a crossing, and each vehicle claims its part from the others.
#include "actors/services/crossing/crossing_driver.hpp"
#include "actors/services/crossing/crossing_sides.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"

#include <chrono>
#include <memory>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

class crossing_management final : public service_type {
public:
  crossing_management() {
    // With what is on its way, own rules are back 150 ms after a silence began.
    options.limits = {100ms, 120ms, 500ms};
    options.period = 50ms;
    options.input_period = 100ms;
    options.compute = {.run_time_mean = 1ms,
                       .run_time_sd = 200us,
                       .run_time_max = 10ms,
                       .demand = {},
                       .input_octets = 185};
  }

  std::string_view name() const override { return "crossing_management"; }

  void visit_options(option_visitor& s) override {
    service_type::visit_options(s);
    s.table("area", [this](option_visitor& t) { area_.visit_options(t); });
  }

  offloading::service in(const service_world& world) const override {
    auto shared = shared_in(world);
    return {.name = name(),
            .options = options,
            .in_vehicle =
                [shared](const auto& vehicle) {
                  return make_crossing_in_vehicle(shared, vehicle);
                },
            .at_provider =
                [shared](const auto& provider) {
                  return make_crossing_at_provider(shared, provider);
                }};
  }

  service_client spawn_client(const client_place& where) const override {
    return {spawn_crossing_driver(where, here_, options.input_period)};
  }

private:
  // `in` is called before any vehicle is spawned, and clients only read.
  crossing_world_ptr shared_in(const service_world& world) const {
    if (!here_ || here_->streets != world.streets)
      here_ = std::make_shared<const crossing_world>(
          world.streets, world.where, world.car, area_,
          std::make_shared<const planners::lane_network>(world.streets->map));
    return here_;
  }

  crossing_options area_;
  mutable crossing_world_ptr here_;
};

} // namespace

service_type_ptr service_crossing_management() {
  return std::make_shared<crossing_management>();
}

} // namespace sofof::actors
