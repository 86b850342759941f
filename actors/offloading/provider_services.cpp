// Services of a provider are found by name; each has one context.
#include "actors/offloading/provider_services.hpp"

#include "actors/offloading/measured_times.hpp"
#include "actors/runtime/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sofof::actors {

namespace {

/// Records of doubted stations.
constexpr double doubts_per_s = 5;
constexpr double doubts_at_once = 50;

} // namespace

provider_services::provider_services(const provider_actor_setup& setup,
                                     std::function<time_point()> clock)
    : id_{setup.id}, place_{std::make_shared<channel::vehicle_place>()},
      compute_{setup.compute}, load_{setup.load},
      workers_{std::make_shared<channel::shared_server_queue>(
          static_cast<unsigned>(compute_.workers), load_)},
      seed_{setup.seed}, number_{setup.number},
      virtual_time_{setup.virtual_time}, clock_{std::move(clock)},
      doubts_{doubts_per_s, doubts_at_once} {
  offloading::provider_context here{provider_station(number_), setup.position,
                                    clock_, id_, virtual_time_};
  here.report = [recorder = setup.recorder](auto event) {
    send_record(recorder, std::move(event));
  };
  if (setup.reach_m)
    here.rides = [place = place_, from = setup.position] {
      return place->last().value_or(from);
    };
  for (const auto& what : setup.services) {
    services_.push_back(at_provider(what, here));
    auto* listener = listener_of(*services_.back().here);
    if (listener && std::ranges::find(listeners_, listener) == listeners_.end())
      listeners_.push_back(listener); // services may share it
  }
}

offloading::cycle_setup
provider_services::make(const offloading::session_start& start) const {
  const auto& service = *std::ranges::find(services_, start.session.service,
                                           &offloading::offered_service::name);
  auto made = cycle_of(service, start);
  made.finish = computing_time(service, made.function, start.session.station);
  return made;
}

std::function<offloading::cycle_work(time_point, std::uint64_t)>
provider_services::computing_time(
    const offloading::offered_service& service,
    std::shared_ptr<const offloading::service_function> function,
    station_id station) const {
  if (!virtual_time_)
    return [clock = clock_, load = load_, name = service.name](time_point start,
                                                               std::uint64_t) {
      const auto done = std::max(clock(), start);
      if (load)
        load->add(start, duration{0}, done - start, name.view());
      return offloading::cycle_work{done, done - start};
    };
  return
      [draws = channel::result_draws(seed_, station, number_),
       compute = compute_, demand = world::demand_of(service.options.compute),
       queue = workers_, name = service.name, function = std::move(function),
       mean = service.options.compute.run_time_mean](time_point start,
                                                     std::uint64_t cycle) {
        const auto known = measured_time(*function, cycle);
        const auto share =
            known ? to_seconds(*known) / std::max(to_seconds(mean), 1e-9) : 1.0;
        const auto work = compute.computing_time(draws, cycle, demand * share);
        return offloading::cycle_work{queue->finish(start, work, name.view()),
                                      work};
      };
}

messages::event_record
provider_services::record_of(const planners::station_doubt& x) const {
  const auto why =
      x.begins ? fmt::format("{} value={:.3f} limit={:.3f}",
                             planners::name_of(x.check), x.value, x.limit)
               : std::string{};
  return {.at = x.at,
          .what = x.begins ? messages::event_type::doubted
                           : messages::event_type::believed,
          .station = x.station,
          .provider = id_,
          .detail = why};
}

offloading::provider_setup rules_of(provider_actor_setup setup,
                                    const provider_services& services) {
  const auto& compute = setup.compute;
  const auto longest = compute.bound();
  return {.id = setup.id,
          .position = setup.position,
          .area = std::move(setup.area),
          .services = services.offered(),
          .policy = std::move(setup.codm),
          .computer = {static_cast<std::size_t>(compute.workers),
                       compute.mean_s(),
                       compute.deviation_s(),
                       longest.at_most_s,
                       {longest.probability, longest.beyond_s}},
          .map = std::move(setup.map),
          .noise = setup.seed,
          .trace = setup.trace,
          .reach_m = setup.reach_m};
}

} // namespace sofof::actors
