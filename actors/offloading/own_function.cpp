// Run times are drawn in virtual time, and taken where time is real.
#include "actors/offloading/own_function.hpp"

#include <algorithm>
#include <utility>

namespace sofof::actors {

offloading::cycle_setup own_function(const requester_actor_setup& vehicle,
                                     const offloading::onboard_service& service,
                                     std::function<time_point()> clock) {
  auto own = own_cycle(service, vehicle.station, vehicle.noise);
  if (!vehicle.virtual_time) {
    own.finish = [clock = std::move(clock)](time_point start, std::uint64_t) {
      const auto done = std::max(clock(), start);
      return offloading::cycle_work{done, done - start};
    };
    return own;
  }
  const auto noise = vehicle.noise.part(service.name.view());
  own.finish = [compute = on(vehicle.computer, service.options).compute,
                host = vehicle.host, draws = noise.part("local run time")](
                   time_point start, std::uint64_t cycle) {
    const auto drawn =
        from_seconds(draws.normal(to_seconds(compute.run_time_mean),
                                  to_seconds(compute.run_time_sd), cycle));
    const auto work = std::clamp(drawn, duration{0}, compute.run_time_max);
    return offloading::cycle_work{start + host.draw(draws, cycle) + work, work};
  };
  return own;
}

offloading::requester_setup
rules_of(requester_actor_setup vehicle,
         std::vector<offloading::onboard_service> services) {
  return {.station = vehicle.station,
          .services = std::move(services),
          .chain = std::move(vehicle.chain),
          .policy = std::move(vehicle.lodm),
          .computer = vehicle.computer,
          .noise = vehicle.noise,
          .path_ahead = std::move(vehicle.path_ahead),
          .future = std::move(vehicle.future),
          .trace = vehicle.trace};
}

} // namespace sofof::actors
