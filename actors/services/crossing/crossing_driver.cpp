// Mailbox and clock of a member of a crossing.
#include "actors/services/crossing/crossing_driver.hpp"

#include "actors/runtime/time.hpp"
#include "actors/services/planning/drive_words.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/simulation/driven_car.hpp"
#include "messages/v2x/encoded.hpp"
#include "planners/crossing/crossing_member.hpp"
#include "planners/crossing/crossing_ways.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

struct crossing_driver_state {
  static inline const char* name = "crossing_driver";

  messages::crossing_driver_actor::pointer self = nullptr;
  messages::vehicle_actor vehicle;
  crossing_world_ptr world;
  duration input_period{};
  world::route_ptr way;
  messages::requester_manager_actor manager;
  std::optional<planners::crossing_member> member;
  std::optional<planners::crossing_ways> ways;
  planners::route_profile_ptr profile;
  std::optional<time_point> told;
  std::optional<own_drive> own; // as it was told last
  messages::etsi::mcm word;

  void on_own(const messages::payload& x) {
    const auto drive = x.as<own_drive>();
    if (!drive)
      return;
    own = *drive;
    const auto t = now(self);
    member->move(t, place());
    planners::crossing_view view;
    member->look(t, view);
    self->send(vehicle, messages::payload::of(view));
    if (std::getenv("WHY") && t.time_since_epoch().count() % 1000000000 < 50000000) {
      const auto* d = member->drive(); const auto pl = place();
      double in = -1; if (d) for (auto& p : d->points) if (p.s_m >= pl.line_m - world->car.front_m) { in = to_seconds(d->start - t) + p.t_s; break; }
      double pin = -1; for (auto& p : own->plan->points) if (p.s_m >= pl.line_m - world->car.front_m) { pin = to_seconds(own->plan->start - t) + p.t_s; break; }
      std::printf("CAR t %.2f %s s %.1f v %.2f line %.1f state %d enters %.2f plan %.2f told %zu\n", to_seconds(t - time_point{}), way->name().c_str(), own->s_m, own->own.speed_mps, pl.line_m - own->s_m - world->car.front_m, (int)member->state(), in, pin, view.told.size());
    }
    if (told && t - *told < input_period)
      return;
    told = t;
    if (manager)
      self->send(manager, messages::service_input{
                              {},
                              t,
                              messages::payload::of(crossing_request{
                                  way->name(), own->own, own->s_m})});
    tell(t);
  }

  planners::crossing_member::place place() {
    constexpr double look_m = 200, passed_m = 1000;
    planners::crossing_member::place is{
        own->s_m, own->own.speed_mps, own->s_m - passed_m, own->s_m - passed_m,
        own->own.position, own->plan.get()};
    if (const auto at = ways->find(profile, own->s_m, look_m)) {
      const auto& through = (*ways)[at->way];
      const auto half_m = (world->car.front_m + world->car.rear_m) / 2;
      is.line_m = through.enters_m + half_m + at->lap_m;
      is.clear_m = through.leaves_m - half_m + at->lap_m;
    }
    return is;
  }

  void tell(time_point t) {
    const auto says = member->tell(t);
    // What it claims; else what it is going to do, which others go by.
    const auto plan = rest(says.drive ? *member->drive() : *own->plan, t);
    const auto ahead = way->waypoints(own->s_m, protocol::authority_m,
                                      protocol::authority_spacing_m);
    messages::mcm_uplink up{own->own, ahead, plan.empty() ? nullptr : &plan, {}};
    up.answer.emplace(messages::maneuver_name{},
                      says.drive ? messages::etsi::maneuver_response::accept
                                 : messages::etsi::maneuver_response::reject);
    auto message =
        messages::encoded(messages::make_word(up, world->car, *world->where));
    if (!message.octets.empty())
      self->send(vehicle, std::move(message));
  }

  /// @returns what is left of a drive, but at most 20 s.
  static world::trajectory rest(const world::trajectory& drive, time_point t) {
    constexpr std::size_t most = 200;
    auto left = world::rest_of(drive, t);
    if (left.points.size() > most)
      left.points.resize(most);
    if (left.points.size() < 2)
      left.points.clear();
    return left;
  }

  void on_word(point from, const messages::its_pdu& message) {
    if (!messages::etsi::decode(message.view(), word))
      return;
    const auto t = now(self);
    const auto said = messages::read_word(word, *world->where, t);
    if (!said)
      return;
    auto drive = drive_of(*said, world->where->frame, world->car);
    planners::crossing_claim claim{said->from, said->at, std::nullopt};
    if (is_claim(*said) && !drive.empty())
      claim.drive = drive;
    member->hear(t, claim, drive, from);
  }
};

messages::crossing_driver_actor::behavior_type crossing_driver(
    messages::crossing_driver_actor::stateful_pointer<crossing_driver_state>
        self,
    const messages::vehicle_actor& vehicle, station_id station,
    world::route_ptr way, crossing_world_ptr world, duration input_period) {
  auto& state = self->state;
  state.self = self;
  state.vehicle = vehicle;
  state.member.emplace(station, world->car);
  state.ways.emplace(world->lanes,
                     planners::crossing_ways::area{world->options.centre,
                                                   world->options.radius_m},
                     world->car);
  state.profile = std::make_shared<const planners::route_profile>(
      way, planners::comfort_limits{});
  state.way = std::move(way);
  state.world = std::move(world);
  state.input_period = input_period;
  self->send(vehicle, messages::crossing_driver_actor{self});
  return {
      [self](const messages::service_result& result) {
        if (const auto drive = result.what.as<world::trajectory>();
            drive && drive->is_sound())
          self->state.member->advise(now(self), *drive);
      },
      [self](const messages::source_change& change) {
        if (!change.remote)
          self->state.member->end_advice();
      },
      [self](const messages::requester_manager_actor& manager) {
        self->state.manager = manager;
      },
      [self](const messages::payload& own) { self->state.on_own(own); },
      [self](point from, const messages::its_pdu& message) {
        self->state.on_word(from, message);
      },
  };
}

} // namespace

messages::crossing_driver_actor spawn_crossing_driver(const client_place& where,
                                                      crossing_world_ptr world,
                                                      duration input_period) {
  return where.system.spawn(crossing_driver, where.vehicle, where.station,
                            where.way, std::move(world), input_period);
}

} // namespace sofof::actors
