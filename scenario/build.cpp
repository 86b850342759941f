// From a scenario to actors.
#include "scenario/build.hpp"

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/supervisor.hpp"
#include "actors/simulation/crash_injector.hpp"
#include "actors/simulation/network_link.hpp"
#include "actors/simulation/road.hpp"
#include "actors/simulation/vehicle.hpp"
#include "channel/with_outage.hpp"
#include "scenario/channel_oracle.hpp"
#include "scenario/placement.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <ranges>

namespace sofof {

namespace {

/// Everybody's noise comes from the seed through streams with names.
random_stream noise_of(const scenario& s, std::string_view what) {
  return random_stream{static_cast<std::uint64_t>(s.seed), what};
}

/// So long what was said last may take to leave this process.
constexpr duration last_words = std::chrono::milliseconds{200};

/// A provider, from one boot to its end, and the radio cell round it.
struct site {
  std::uint32_t place; // in the file
  roadside_provider_actor provider;
  const provider_options* options;
  std::shared_ptr<const channel_profile> channel;

  bool may_die() const { return options->fails_at.has_value(); }

  std::shared_ptr<multi_server_queue> cell_up =
      std::make_shared<multi_server_queue>(1);
  std::shared_ptr<multi_server_queue> cell_down =
      std::make_shared<multi_server_queue>(1);
};

std::vector<service_type_ptr> offered(const scenario& s,
                                      const provider_options& options) {
  if (options.services.empty())
    return s.services;
  std::vector<service_type_ptr> kinds;
  for (const auto& kind : s.services)
    if (std::ranges::find(options.services, kind->name())
        != options.services.end())
      kinds.push_back(kind);
  return kinds;
}

/// A plan is fresh up to the longest time between two usable ones.
/// Source: latency limit + gap limit + one planning period.
duration fresh_limit(const scenario& s) {
  duration limit{0};
  for (const auto& kind : s.services)
    if (kind->name() == "trajectory_planning")
      limit = kind->common.limits.max_latency
              + kind->common.limits.max_interarrival + kind->common.period;
  return limit;
}

roadside_provider_actor spawn_provider(caf::actor_system& sys,
                                       const scenario& s, std::uint32_t number,
                                       const georeference_ptr& where,
                                       const recorder_actor& recorder,
                                       std::uint64_t start, bool virtual_time) {
  const auto& options = s.providers[number];
  provider_setup setup;
  setup.boot = boot_of(number + 1, start);
  setup.position = options.position_m;
  setup.area = options.area();
  setup.world = s.world;
  setup.where = where;
  setup.kinds = offered(s, options);
  setup.codm = s.policies.codm->clone();
  setup.recorder = recorder;
  setup.profile = s.channel_to(number);
  setup.seed = noise_of(s, "network");
  setup.number = number;
  setup.virtual_time = virtual_time;
  setup.crossings_granted = s.traffic.grants_crossings();
  return spawn_service_provider(sys, std::move(setup));
}

/// @returns those of providers; none where the cars drive in other processes:
/// they would tell of an empty road, and speak against every car.
std::vector<roadside_sensor> sensors_beside(const scenario& s,
                                            const std::vector<site>& sites,
                                            const part& here) {
  if (here.serves_others)
    return {};
  const auto noise = noise_of(s, "roadside sensors");
  std::vector<roadside_sensor> beside;
  for (std::size_t p = 0; p < sites.size(); ++p) {
    const auto& own = sites[p].options->sensors;
    const auto drawn = noise.part(sites[p].place);
    for (std::size_t k = 0; k < own.size(); ++k)
      beside.push_back({sites[p].provider, own[k].make(drawn.part(k))});
  }
  return beside;
}

std::vector<oriented_box> obstacles(const scenario& s) {
  std::vector<oriented_box> boxes;
  for (const auto& o : s.obstacles)
    boxes.push_back(o.box());
  return boxes;
}

antenna connect(caf::actor_system& sys, const scenario& s, station_id station,
                const site& at) {
  const channel draws{at.channel, noise_of(s, "network"), station, at.place,
                      at.options->radio};
  return {spawn_network_link(sys, at.provider,
                             {{draws, way::up, at.cell_up},
                              {draws, way::down, at.cell_down},
                              std::nullopt}),
          at.options->position_m, at.options->range_m};
}

// Real delays take the place of modelled ones.
antenna connect(caf::actor_system& sys, const scenario& s, station_id station,
                const part::remote_provider& to,
                const provider_outbox& outbox) {
  auto far = spawn_provider_proxy(sys, station, outbox);
  introduce(outbox, station, far);
  const auto& at = s.providers[to.place];
  return {std::move(far), at.position_m, at.range_m};
}

// The vehicle calls it later, from its own thread: nothing is borrowed.
auto requester_maker(caf::actor_system& sys, const scenario& s,
                     const placed_vehicle& v, const georeference_ptr& where,
                     const recorder_actor& recorder, bool virtual_time,
                     const decltype(foresee(s))& future) {
  return [&sys, v, where, recorder, virtual_time, world = s.world,
          kinds = s.services, lodm = s.policies.lodm,
          noise = noise_of(s, "vehicle").part(v.station),
          granted = s.traffic.grants_crossings(),
          computer = s.fleets[v.fleet].computer, margins = s.record.margins,
          future](const vehicle_actor& vehicle) {
    return spawn_service_requester(
        sys, {v.station, v.way, world, where, kinds, lodm->clone(), vehicle,
              recorder, noise, virtual_time, granted, computer,
              future ? future(v.station) : nullptr, margins});
  };
}

/// Actors that must live as long as the run, and what they are called.
using names = std::vector<std::pair<caf::actor, std::string>>;

template <class Handle>
void name(names& all, const Handle& actor, std::string what) {
  all.emplace_back(caf::actor_cast<caf::actor>(actor), std::move(what));
}

void end(const std::vector<caf::actor>& leaving, runtime& time) {
  for (const auto& actor : leaving)
    caf::anon_send_exit(actor, caf::exit_reason::user_shutdown);
  time.await_end(leaving);
}

template <class Handle>
void end(const std::vector<Handle>& leaving, runtime& time) {
  std::vector<caf::actor> actors;
  for (const auto& actor : leaving)
    actors.push_back(caf::actor_cast<caf::actor>(actor));
  end(actors, time);
}

} // namespace

world_actors build(caf::actor_system& sys, const scenario& s,
                   std::shared_ptr<record_sink> sink, etsi::its_clock clock,
                   bool virtual_time,
                   std::function<void(const std::string&)> on_loss,
                   const part& here) {
  world_actors world;
  const vehicle_params car;
  const auto where = std::make_shared<const georeference>(
      geo_frame{s.world->map.origin()}, clock);
  std::vector<placed_vehicle> placed;
  station_routes ways;
  for (auto& v : place_vehicles(s))
    if (here.drives(v.station)) {
      ways[v.station] = v.way;
      placed.push_back(std::move(v));
    }
  names watched;
  world.recorder = spawn_recorder(sys, std::move(sink));
  name(watched, world.recorder, "the recorder");
  world.has_peers = here.serves_others || !here.remotes.empty();
  std::vector<site> sites;
  const auto boot = [&](std::uint32_t k, std::uint64_t start,
                        std::shared_ptr<const channel_profile> channel) {
    sites.push_back(
        {k,
         spawn_provider(sys, s, k, where, world.recorder, start, virtual_time),
         &s.providers[k], std::move(channel)});
    world.providers.push_back(sites.back().provider);
  };
  for (std::uint32_t k = 0; k < s.providers.size(); ++k) {
    if (!here.provides(k))
      continue;
    const auto& options = s.providers[k];
    boot(k, here.start, s.channel_to(k));
    if (options.fails_at)
      world.power_cuts.push_back(spawn_power_cut(
          sys, caf::actor_cast<caf::actor>(world.providers.back()),
          *options.fails_at));
    else
      name(watched, world.providers.back(),
           fmt::format("provider {}", options.name));
    // It lives from the start on, but nothing reaches it.
    if (options.returns_at)
      boot(k, here.start + 1,
           with_outage(*s.channel_to(k), {}, *options.returns_at));
  }
  for (const auto& to : here.remotes) {
    world.connections.push_back(to.spawn_provider_connection(world.recorder));
    name(watched, world.connections.back(),
         fmt::format("the connection to provider {}",
                     s.providers[to.place].name));
  }
  world.road =
      spawn_road(sys, {s.world, ways, car, s.sensors, noise_of(s, "sensors"),
                       sensors_beside(s, sites, here), obstacles(s),
                       world.recorder, s.traffic.grants_crossings()});
  name(watched, world.road, "the road");
  const auto future = virtual_time ? foresee(s) : nullptr;
  for (const auto& v : placed) {
    vehicle_setup setup;
    setup.station = v.station;
    setup.way = v.way;
    setup.start_s_m = v.start_s_m;
    setup.start_speed_mps = s.fleets[v.fleet].start_speed_mps;
    setup.appears_after = v.appears;
    setup.car = car;
    setup.sensor = s.sensors;
    setup.where = where;
    setup.fresh_limit = fresh_limit(s);
    setup.track_period = s.record.tracks ? s.record.tracks_period : duration{0};
    const auto watch_link = [&](const antenna& a) {
      name(watched, a.link, fmt::format("a link of vehicle {}", v.station));
    };
    if (s.fleets[v.fleet].connected) {
      setup.v2x = s.v2x;
      for (const auto& at : sites) {
        setup.antennas.push_back(connect(sys, s, v.station, at));
        if (!at.may_die())
          watch_link(setup.antennas.back());
      }
      for (std::size_t k = 0; k < here.remotes.size(); ++k) {
        setup.antennas.push_back(
            connect(sys, s, v.station, here.remotes[k], world.connections[k]));
        watch_link(setup.antennas.back());
      }
    }
    for (const auto& a : setup.antennas)
      world.links.push_back(a.link);
    setup.road = world.road;
    setup.recorder = world.recorder;
    setup.spawn_requester =
        requester_maker(sys, s, v, where, world.recorder, virtual_time, future);
    world.vehicles.push_back(spawn_vehicle(sys, std::move(setup)));
    name(watched, world.vehicles.back(), fmt::format("vehicle {}", v.station));
  }
  if (on_loss)
    world.supervisor =
        spawn_supervisor(sys, std::move(watched), std::move(on_loss));
  return world;
}

void dismiss(const world_actors& actors, runtime& time) {
  if (actors.supervisor)
    end(std::vector{actors.supervisor}, time);
  end(actors.power_cuts, time);
  end(actors.vehicles, time);
  end(actors.providers, time);
  if (actors.has_peers)
    time.run_until(time.now() + last_words); // they are under way
  end(actors.links, time);
  end(actors.connections, time);
  end(std::vector{actors.road}, time);
  end(std::vector{actors.recorder}, time);
}

} // namespace sofof
