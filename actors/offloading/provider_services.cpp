// Services of a provider are found by name; each has one context.
#include "actors/offloading/provider_services.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sofof {

namespace {

/// Records of doubted stations.
constexpr double doubts_per_s = 5;
constexpr double doubts_at_once = 50;

} // namespace

provider_services::provider_services(const provider_setup& setup,
                                     std::function<time_point()> clock)
    : id_{setup.boot}, position_{setup.position}, world_{setup.world},
      where_{setup.where}, types_{setup.kinds}, profile_{setup.profile},
      workers_{std::make_shared<multi_server_queue>(setup.profile->workers)},
      seed_{setup.seed}, number_{setup.number},
      virtual_time_{setup.virtual_time},
      crossings_granted_{setup.crossings_granted}, clock_{std::move(clock)},
      doubts_{doubts_per_s, doubts_at_once} {
  for (std::size_t k = 0; k < types_.size(); ++k)
    contexts_.push_back(types_[k]->make_site(
        setup_of(k, 0, seed_.part(types_[k]->name()).part("site"))));
}

service_setup provider_services::setup_of(std::size_t service,
                                          station_id station,
                                          random_stream noise) const {
  return {.world = world_,
          .where = where_,
          .station = station,
          .remote = true,
          .noise = noise,
          .crossings_granted = crossings_granted_,
          .clock = clock_,
          .site = service < contexts_.size() ? contexts_[service] : nullptr,
          .provider = {provider_station(number_), position_}};
}

std::vector<offloading::offered_service> provider_services::offered() const {
  std::vector<offloading::offered_service> all;
  for (std::size_t k = 0; k < types_.size(); ++k) {
    const auto& type = types_[k];
    all.push_back(
        {.name = type->name(),
         .period = type->common.period,
         .max_latency = type->common.limits.max_latency,
         .demand = type->common.demand,
         .termination_message = [type, here = setup_of(k, 0, seed_)](
                                    const service_end& end, time_point t) {
           auto setup = here;
           setup.station = end.running.station;
           return type->termination_message(setup, end, t, nullptr);
         }});
  }
  return all;
}

offloading::cycle_setup
provider_services::make(const offloading::session_start& start) const {
  const auto found =
      std::ranges::find(types_, start.session.kind.view(),
                        [](const auto& type) { return type->name(); });
  const auto& type = **found;
  const auto station = start.session.station;
  const auto setup = setup_of(static_cast<std::size_t>(found - types_.begin()),
                              station, seed_.part(type.name()).part(station));
  return {.running = start.session,
          .function = type.make_function(setup),
          .period = type.common.period,
          .phase = start.phase,
          .finish = computing_time(type, station),
          .keeps_phase = start.keeps_phase};
}

std::function<time_point(time_point, std::uint64_t)>
provider_services::computing_time(const service_type& type,
                                  station_id station) const {
  if (!virtual_time_)
    return [](time_point start, std::uint64_t) { return start; };
  const channel draws{profile_, seed_, station, number_};
  return [draws, demand = type.common.demand,
          queue = workers_](time_point start, std::uint64_t cycle) {
    const auto work = to_seconds(draws.service_time(cycle)) * demand;
    return queue->finish(start, from_seconds(work));
  };
}

event_record provider_services::record_of(const station_doubt& x) const {
  const auto why = x.begins ? fmt::format("{} value={:.3f} limit={:.3f}",
                                          name_of(x.check), x.value, x.limit)
                            : std::string{};
  return {x.at,      x.begins ? event_type::doubted : event_type::believed,
          x.station, id_,
          {},        0,
          why};
}

offloading::provider_setup rules_of(provider_setup setup,
                                    const provider_services& services) {
  const auto& profile = *setup.profile;
  return {.id = setup.boot,
          .position = setup.position,
          .area = std::move(setup.area),
          .services = services.offered(),
          .policy = std::move(setup.codm),
          .computer = {static_cast<std::size_t>(profile.workers),
                       profile.mean_service_s(), profile.service_deviation_s()},
          .map = {setup.world, &setup.world->map},
          .noise = setup.seed};
}

} // namespace sofof
