// Run times are drawn in virtual time, and taken where time is real.
#include "actors/offloading/own_function.hpp"

#include "actors/offloading/measured_times.hpp"
#include "actors/runtime/recorder.hpp"

#include <algorithm>
#include <utility>

namespace sofof::actors {

namespace {

/// What a cycle computes on board: as it was measured, at the usual clock, or
/// drawn.
duration run_time(const offloading::service_function& function,
                  const world::cycle_options& compute, double slower,
                  const random_stream& draws, std::uint64_t cycle) {
  if (const auto known = measured_time(function, cycle))
    return from_seconds(to_seconds(*known) * slower);
  const auto drawn =
      from_seconds(draws.normal(to_seconds(compute.run_time_mean),
                                to_seconds(compute.run_time_sd), cycle));
  return std::clamp(drawn, duration{0}, compute.run_time_max);
}

} // namespace

offloading::vehicle_context context_of(const requester_actor_setup& vehicle,
                                       std::function<time_point()> clock) {
  return {vehicle.station, std::move(clock), vehicle.virtual_time,
          [recorder = vehicle.recorder](messages::event_record event) {
            send_record(recorder, std::move(event));
          }};
}

offloading::cycle_setup own_function(const requester_actor_setup& vehicle,
                                     const offloading::onboard_service& service,
                                     std::function<time_point()> clock,
                                     const channel::core_seat& seat) {
  auto own = own_cycle(service, vehicle.station, vehicle.noise);
  if (!vehicle.virtual_time) {
    own.finish = [clock = std::move(clock)](time_point start, std::uint64_t) {
      const auto done = std::max(clock(), start);
      return offloading::cycle_work{done, done - start};
    };
    return own;
  }
  const auto noise = vehicle.noise.part(service.name.view());
  const auto compute = on(vehicle.computer, service.options).compute;
  const auto draws = noise.part("local run time");
  const auto work_of = [function = own.function, compute,
                        slower =
                            world::usual_clock_ghz / vehicle.computer.clock_ghz,
                        draws](std::uint64_t cycle) {
    return run_time(*function, compute, slower, draws, cycle);
  };
  if (!seat.core) {
    own.finish = [work_of, host = vehicle.host, draws](time_point start,
                                                       std::uint64_t cycle) {
      const auto work = work_of(cycle);
      return offloading::cycle_work{start + host.draw(draws, cycle) + work,
                                    work};
    };
    return own;
  }
  own.finish = [seat, work_of, period = own.period](time_point start,
                                                    std::uint64_t cycle) {
    const auto work = work_of(cycle);
    seat.core->begin(seat.number, start, work, start + period);
    return offloading::cycle_work{seat.core->done_at(seat.number, start), work};
  };
  own.review = [seat](time_point now) {
    return seat.core->done_at(seat.number, now);
  };
  return own;
}

offloading::requester_setup
rules_of(requester_actor_setup vehicle,
         std::vector<offloading::onboard_service> services) {
  return {.station = vehicle.station,
          .services = std::move(services),
          .policy = std::move(vehicle.lodm),
          .computer = vehicle.computer,
          .noise = vehicle.noise,
          .path_ahead = std::move(vehicle.path_ahead),
          .future = std::move(vehicle.future),
          .forecast = std::move(vehicle.forecast),
          .trace = vehicle.trace};
}

} // namespace sofof::actors
