// From a scenario to actors.
#include "scenario/build.hpp"

#include "actors/offloading/service_provider.hpp"
#include "actors/offloading/service_requester.hpp"
#include "actors/remote/provider_connection.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/supervisor.hpp"
#include "actors/runtime/time.hpp"
#include "actors/simulation/air.hpp"
#include "actors/simulation/comfortable_roads.hpp"
#include "actors/simulation/crash_injector.hpp"
#include "actors/simulation/road.hpp"
#include "actors/simulation/service_client.hpp"
#include "actors/simulation/vehicle.hpp"
#include "base/protocol.hpp"
#include "channel/with_outage.hpp"
#include "messages/broadcast/decode_broadcast.hpp"
#include "scenario/channel_oracle.hpp"
#include "scenario/placement.hpp"
#include "scenario/plan_limits.hpp"
#include "scenario/roadside.hpp"
#include "scenario/vehicle_connections.hpp"
#include "scenario/vehicle_schedule.hpp"
#include "scenario/vehicle_views.hpp"

#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <ranges>
#include <tuple>
#include <utility>

namespace sofof::scenario {

namespace {

/// Everybody's noise comes from the seed through streams with names.
random_stream noise_of(const scenario_definition& s, std::string_view what) {
  return random_stream{static_cast<std::uint64_t>(s.seed), what};
}

/// So long what was said last may take to leave this process.
constexpr duration last_words = std::chrono::milliseconds{200};

/// Gives the functions of one vehicle the cores that they share.
void share_cores(std::vector<actors::client_service>& services,
                 const vehicle_schedule& schedule) {
  const auto seats = seats_of(schedule);
  for (std::size_t k = 0; k < services.size(); ++k) {
    services[k].seat = seats[k];
    services[k].service.options.shared_response =
        schedule.functions[k].at_most.value_or(duration::max());
  }
}

/// @returns whether any channel depends on where a vehicle is.
bool has_areas(const scenario_definition& s) {
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    if (!s.channel_to(k)->areas.empty())
      return true;
  return false;
}

/// What stands on the road comes first, in the order of the file.
std::vector<oriented_box> standing(const scenario_definition& s) {
  std::vector<oriented_box> boxes;
  for (const auto& o : s.obstacles)
    if (!o.moves())
      boxes.push_back(o.box());
  return boxes;
}

std::vector<world::scripted_body> scripted(const scenario_definition& s) {
  std::vector<world::scripted_body> all;
  auto number = static_cast<std::uint32_t>(std::ranges::count_if(
      s.obstacles, std::not_fn(&obstacle_options::moves)));
  for (const auto& o : s.obstacles)
    if (o.moves())
      all.push_back(o.script(obstacle_id(number++)));
  return all;
}

provider_load measured(const provider_options& provider,
                       const channel::provider_compute& compute,
                       time_point start) {
  const auto meter = [start](std::int64_t servers) {
    return std::make_shared<channel::load_meter>(static_cast<unsigned>(servers),
                                                 start);
  };
  return {provider.name,
          compute.worker_w,
          meter(compute.workers),
          meter(1),
          meter(1),
          std::make_shared<channel::octet_ledger>(start),
          std::make_shared<channel::octet_ledger>(start)};
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

/// Spawns one run, group by group.
class builder {
public:
  builder(caf::actor_system& sys, const scenario_definition& s,
          std::shared_ptr<messages::record_sink> sink,
          messages::etsi::its_clock clock, bool virtual_time,
          std::function<void(const std::string&)> on_loss,
          const process_share& here)
      : sys_{sys}, s_{s}, here_{here},
        virtual_time_{virtual_time}, start_{actors::now(sys)},
        where_{std::make_shared<const messages::georeference>(
            messages::geo_frame{s.world->map.origin()}, clock)},
        decode_{
            [where = where_](const messages::its_pdu& message, time_point now) {
              return messages::decode(message, *where, now);
            }} {
    services_ = services_in(s.world, {}, {});
    if (on_loss)
      world_.supervisor = actors::spawn_supervisor(sys, std::move(on_loss));
    world_.recorder = actors::spawn_recorder(sys_, std::move(sink));
    watch(world_.recorder, "the recorder");
    world_.has_peers = here.serves_others || !here.remotes.empty();
  }

  world_actors build() {
    for (std::uint32_t k = 0; k < s_.providers.size(); ++k)
      if (lives_here(s_, here_, k))
        add_provider(k);
    for (const auto& to : here_.remotes)
      add_connection(to);
    auto placed = place_vehicles(s_);
    std::erase_if(placed,
                  [&](const auto& v) { return !here_.drives(v.station); });
    add_road(placed);
    add_antennas();
    world_.forecasts = std::make_shared<place_forecasts>(s_);
    const auto future = virtual_time_ ? foresee(s_) : nullptr;
    for (const auto& v : placed)
      add_vehicle(v, future ? future(v.station) : nullptr);
    return std::move(world_);
  }

private:
  /// It must live as long as the run.
  template <class Handle>
  void watch(const Handle& actor, const std::string& name) {
    if (world_.supervisor)
      actors::watch(world_.supervisor, caf::actor_cast<caf::actor>(actor),
                    name);
  }

  /// @param streets  What is known of them where the services run.
  /// @param beside   The sensors that tell what they see there.
  /// @param programs What runs there in place of programs of services.
  std::vector<offloading::service>
  services_in(const world::streets_ptr& streets,
              std::span<const roadside_options> beside,
              const std::vector<actors::program_at_provider>& programs) const {
    actors::service_world known{
        streets, where_, {}, s_.traffic.grants_crossings(), s_.sensors, {}};
    if (const auto* planning = planning_service(s_))
      known.rss = planning->assumed();
    known.programs = programs;
    for (const auto& options : beside) {
      const auto sensor = options.make({0, ""});
      known.roadside.push_back(sensor.view());
      known.eyes = noisier(known.eyes, sensor.can);
    }
    std::vector<offloading::service> all;
    for (const auto& type : s_.services) {
      all.push_back(type->in(known));
      if (find_service(s_, type->follows()))
        all.back().follows = type->follows();
    }
    return all;
  }

  // -- providers ------------------------------------------------------------

  void add_provider(std::uint32_t number) {
    const auto& options = s_.providers[number];
    world_.loads.push_back(
        measured(options, s_.compute_of(number), actors::now(sys_)));
    start(number, here_.start, s_.channel_to(number));
    if (options.fails_at)
      world_.crash_injectors.push_back(actors::spawn_crash_injector(
          sys_, caf::actor_cast<caf::actor>(world_.providers.back()),
          *options.fails_at));
    else
      watch(world_.providers.back(), fmt::format("provider {}", options.name));
    // It lives from the start on, but nothing reaches it.
    if (options.returns_at)
      start(number, here_.start + 1,
            channel::with_outage(*s_.channel_to(number), {},
                                 *options.returns_at));
  }

  void start(std::uint32_t number, std::uint64_t at,
             std::shared_ptr<const channel::channel_profile> channel) {
    const auto& load = world_.loads.back();
    const auto cell = [](const std::shared_ptr<channel::load_meter>& meter) {
      return std::make_shared<channel::shared_server_queue>(1, meter);
    };
    cells_.push_back({number, spawn_provider(number, at), &s_.providers[number],
                      std::move(channel), cell(load.cell_up),
                      cell(load.cell_down), load.octets_up, load.octets_down});
    world_.providers.push_back(cells_.back().provider);
    if (const auto& carrier = s_.providers[number].carrier)
      riders_[carrier->station] = {cells_.back().provider,
                                   std::make_shared<channel::vehicle_place>()};
  }

  /// @returns what reads messages, and tells of CAMs whoever wants to know.
  std::function<messages::broadcast(const messages::its_pdu&, time_point)>
  told() const {
    if (!here_.on_heard)
      return decode_;
    return [decode = decode_, tell = here_.on_heard](
               const messages::its_pdu& message, time_point now) {
      auto heard = decode(message, now);
      if (const auto* cam = std::get_if<messages::cam>(&heard))
        tell(*cam, now);
      return heard;
    };
  }

  messages::roadside_provider_actor spawn_provider(std::uint32_t number,
                                                   std::uint64_t start) {
    const auto& options = s_.providers[number];
    actors::provider_actor_setup setup;
    setup.id = provider_at(number + 1, start);
    setup.position = options.position_m;
    setup.area = options.carrier ? options.area_round({}) : options.area();
    if (options.carrier)
      setup.reach_m = options.reach_m();
    const auto& own = options.streets;
    const auto& streets = own ? own : s_.world;
    setup.map = {streets, &streets->map};
    setup.decode = told();
    const auto beside = here_.serves_others
                            ? std::span<const roadside_options>{}
                            : std::span{options.sensors};
    const auto services = own || !beside.empty() || !options.programs.empty()
                              ? services_in(streets, beside, options.programs)
                              : services_;
    for (const auto& service : services)
      if (options.offers(service.name.view()))
        setup.services.push_back(service);
    setup.codm = s_.policies.codm->clone();
    setup.recorder = world_.recorder;
    setup.compute = s_.compute_of(number);
    setup.load = world_.loads.back().workers;
    setup.seed = noise_of(s_, "network");
    setup.number = number;
    setup.virtual_time = virtual_time_;
    setup.trace = s_.record.trace;
    return actors::spawn_service_provider(sys_, std::move(setup));
  }

  void add_connection(const process_share::remote_provider& to) {
    world_.connections.push_back(to.spawn_provider_connection(world_.recorder));
    watch(world_.connections.back(),
          fmt::format("the connection to provider {}",
                      s_.providers[to.place].name));
  }

  // -- vehicles -------------------------------------------------------------

  void add_road(const std::vector<placed_vehicle>& placed) {
    actors::station_routes ways;
    for (const auto& v : placed)
      ways[v.station] = v.way;
    world_.road = actors::spawn_road(
        sys_, {s_.world, std::move(ways), world::vehicle_params{}, s_.sensors,
               noise_of(s_, "sensors"),
               sensors_beside(noise_of(s_, "roadside sensors"), cells_, here_),
               standing(s_), world_.recorder, s_.traffic.grants_crossings(),
               scripted(s_)});
    watch(world_.road, "the road");
    world_.air =
        actors::spawn_air(sys_, {s_.network.channel, noise_of(s_, "air"), 300,
                                 here_.tell_others});
    watch(world_.air, "the air");
  }

  void add_vehicle(const placed_vehicle& v,
                   std::shared_ptr<const policies::channel_oracle> future) {
    const auto& fleet = s_.fleets[v.fleet];
    actors::vehicle_setup setup;
    setup.car = {v.station,
                 v.way,
                 v.start_s_m,
                 fleet.start_speed_mps,
                 {},
                 fresh_limit(s_),
                 alone_limit(s_),
                 s_.record.tracks ? s_.record.tracks_period : duration{0},
                 roads_.of(v.way),
                 v.left_m,
                 v.turn_rad};
    setup.appears_after = v.appears;
    const auto seeing = make_seeing_client(s_, where_);
    setup.plans = seeing.plans;
    setup.sensor = s_.sensors;
    setup.where = where_;
    if (fleet.connected) {
      setup.v2x = s_.v2x;
      setup.air = world_.air;
      setup.antennas = antennas_;
      if (const auto rider = riders_.find(v.station); rider != riders_.end())
        std::tie(setup.rider, setup.place) = rider->second;
      else if (has_areas(s_))
        setup.place = std::make_shared<channel::vehicle_place>();
      setup.connect = connect(v.station, !fleet.fails_at, setup.place);
    }
    setup.road = world_.road;
    setup.recorder = world_.recorder;
    setup.spawn_requester =
        requester_maker(v, setup.car.road, seeing.view, std::move(future));
    world_.vehicles.push_back(actors::spawn_vehicle(sys_, std::move(setup)));
    watch(world_.vehicles.back(), fmt::format("vehicle {}", v.station));
  }

  // In the order of their links: those of this process, then the others.
  void add_antennas() {
    connections_ = std::make_shared<const vehicle_connections>(
        sys_, noise_of(s_, "network"), start_, std::move(cells_),
        world_.supervisor);
    std::vector<actors::antenna> all;
    const auto add = [&](const provider_options& at) {
      auto& antenna = all.emplace_back(at.position_m, at.range_m);
      if (at.carrier) {
        antenna.carrier = at.carrier->station;
        antenna.rides = riders_.at(at.carrier->station).second;
      }
    };
    for (const auto& cell : connections_->cells())
      add(*cell.options);
    for (const auto& to : here_.remotes)
      add(s_.providers[to.place]);
    antennas_ =
        std::make_shared<const std::vector<actors::antenna>>(std::move(all));
  }

  /// @param lives  Whether the vehicle's computer does to the end.
  std::function<messages::link_actor(std::size_t)>
  connect(station_id station, bool lives,
          std::shared_ptr<const channel::vehicle_place> place) {
    return [here = connections_, station, lives, place = std::move(place),
            far = connect_remotes(station, lives)](std::size_t to) {
      const auto count = here->cells().size();
      return to < count ? here->connect(station, to, lives, place)
                        : far[to - count];
    };
  }

  // Real delays take the place of modelled ones.
  std::vector<messages::link_actor> connect_remotes(station_id station,
                                                    bool lives) {
    std::vector<messages::link_actor> proxies;
    for (const auto& outbox : world_.connections) {
      auto far = actors::spawn_provider_proxy(sys_, station, outbox);
      actors::introduce(outbox, station, far);
      if (lives)
        watch(far, fmt::format("a link of vehicle {}", station));
      world_.proxies.push_back(far);
      proxies.push_back(std::move(far));
    }
    return proxies;
  }

  // The vehicle calls it later, from its own thread: nothing is borrowed.
  std::function<
      messages::onboard_requester_actor(const messages::vehicle_actor&)>
  requester_maker(
      const placed_vehicle& v, const planners::route_profile_ptr& road,
      const std::shared_ptr<actors::vehicle_view>& view,
      std::shared_ptr<const policies::channel_oracle> future) const {
    std::vector<actors::client_service> services;
    for (std::size_t k = 0; k < services_.size(); ++k)
      services.push_back(
          {services_[k], [type = s_.services[k], station = v.station, road,
                          view, recorder = world_.recorder,
                          place = place_in_chain(s_, *s_.services[k])](
                             auto& sys, const auto& car) {
             return type
                 ->spawn_client(
                     {sys, car, station, road, recorder, place, view})
                 .actor;
           }});
    if (const auto at_home = schedule_at_home(s_, v.fleet))
      share_cores(services, *at_home);
    return [&sys = sys_, station = v.station, way = v.way, services,
            lodm = s_.policies.lodm, recorder = world_.recorder,
            noise = noise_of(s_, "vehicle").part(v.station.value()),
            virtual_time = virtual_time_, computer = s_.fleets[v.fleet].compute,
            fails_at = s_.fleets[v.fleet].fails_at, start = start_,
            host = s_.network.channel->vehicle_host, future = std::move(future),
            forecast = world_.forecasts->for_vehicle(),
            margins = s_.record.margins,
            trace = s_.record.trace](const messages::vehicle_actor& vehicle) {
      const auto path_ahead = [way](const messages::ego_state& ego) {
        return way->waypoints(ego.s_m, protocol::route_ahead_m,
                              protocol::route_spacing_m);
      };
      auto requester =
          actors::spawn_service_requester(sys, {.station = station,
                                                .path_ahead = path_ahead,
                                                .services = services,
                                                .lodm = lodm->clone(),
                                                .vehicle = vehicle,
                                                .recorder = recorder,
                                                .noise = noise,
                                                .virtual_time = virtual_time,
                                                .computer = computer,
                                                .host = host,
                                                .future = future,
                                                .forecast = forecast,
                                                .record_margins = margins,
                                                .trace = trace});
      if (fails_at)
        actors::spawn_crash_injector(
            sys, caf::actor_cast<caf::actor>(requester),
            std::max(start + *fails_at - actors::now(sys), duration{0}));
      return requester;
    };
  }

  caf::actor_system& sys_;
  const scenario_definition& s_;
  const process_share& here_;
  bool virtual_time_;
  time_point start_;
  messages::georeference_ptr where_;
  std::function<messages::broadcast(const messages::its_pdu&, time_point)>
      decode_;
  std::vector<offloading::service> services_; // as in the scenario
  std::vector<provider_cell> cells_;          // until the vehicles are added
  // By the vehicles that they ride with, and where these are.
  std::map<station_id, std::pair<messages::roadside_provider_actor,
                                 std::shared_ptr<channel::vehicle_place>>>
      riders_;
  std::shared_ptr<const vehicle_connections> connections_;
  std::shared_ptr<const std::vector<actors::antenna>> antennas_;
  actors::comfortable_roads roads_;
  world_actors world_;
};

} // namespace

bool lives_here(const scenario_definition& s, const process_share& here,
                std::size_t number) {
  const auto& carrier = s.providers[number].carrier;
  return carrier ? here.drives(carrier->station) : here.provides(number);
}

world_actors build(caf::actor_system& sys, const scenario_definition& s,
                   std::shared_ptr<messages::record_sink> sink,
                   messages::etsi::its_clock clock, bool virtual_time,
                   std::function<void(const std::string&)> on_loss,
                   const process_share& here) {
  return builder{
      sys, s, std::move(sink), clock, virtual_time, std::move(on_loss), here}
      .build();
}

void dismiss(const world_actors& actors, runtime& time) {
  if (actors.supervisor)
    end(std::vector{actors.supervisor}, time);
  end(actors.crash_injectors, time);
  end(actors.vehicles, time);
  end(actors.providers, time);
  if (actors.has_peers)
    time.run_until(time.now() + last_words); // they are under way
  end(actors.proxies, time);
  end(actors.connections, time);
  end(std::vector{actors.air}, time);
  end(std::vector{actors.road}, time);
  end(std::vector{actors.recorder}, time);
}

} // namespace sofof::scenario
