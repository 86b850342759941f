// Mailbox and clock of a member of a crossing.
#include "actors/services/crossing/crossing_driver.hpp"

#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "actors/services/planning/drive_words.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/simulation/driven_car.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"
#include "planners/crossing/crossing_member.hpp"
#include "planners/crossing/crossing_ways.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <string>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

struct crossing_driver_state {
  static inline const char* name = "crossing_driver";

  messages::crossing_driver_actor::pointer self = nullptr;
  messages::vehicle_actor vehicle;
  station_id station = 0;
  crossing_world_ptr world;
  duration input_period{};
  planners::route_profile_ptr road;
  messages::recorder_actor recorder;
  messages::requester_manager_actor manager;
  std::optional<planners::crossing_member> member;
  std::optional<planners::crossing_ways> ways;
  std::string lane; // by which it comes, or came when it claimed
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
    record_past();
    planners::crossing_view view;
    member->look(t, view);
    self->send(vehicle, messages::payload::of(view));
    if (told && t - *told < input_period)
      return;
    told = t;
    if (manager)
      self->send(manager, messages::service_input{
                              {},
                              t,
                              messages::payload::of(crossing_request{
                                  way().name(), own->own, own->s_m})});
    tell(t);
  }

  planners::crossing_member::place place() {
    constexpr double look_m = 200, passed_m = 1000;
    planners::crossing_member::place is{own->s_m,
                                        own->own.speed_mps,
                                        own->s_m - passed_m,
                                        own->s_m - passed_m,
                                        own->own.position,
                                        own->plan.get()};
    if (const auto at = ways->find(road, own->s_m, look_m)) {
      const auto& through = (*ways)[at->way];
      const auto half_m = (world->car.front_m + world->car.rear_m) / 2;
      is.line_m = through.enters_m + half_m + at->lap_m;
      is.clear_m = through.leaves_m - half_m + at->lap_m;
      if (member->state() == planners::claim_book::state::free)
        lane = world->streets->map.lanes()[through.lane].name;
    }
    return is;
  }

  void tell(time_point t) {
    const auto says = member->tell(t);
    // What it claims; else what it is going to do, which others go by.
    const auto plan = told_rest(says.drive ? *member->drive() : *own->plan, t);
    const auto ahead = way().waypoints(own->s_m, protocol::authority_m,
                                       protocol::authority_spacing_m);
    messages::mcm_uplink up{
        own->own, ahead, plan.empty() ? nullptr : &plan, {}};
    up.answer.emplace(messages::maneuver_name{},
                      says.drive ? messages::etsi::maneuver_response::accept
                                 : messages::etsi::maneuver_response::reject);
    auto message =
        messages::encoded(messages::make_word(up, world->car, *world->where));
    if (!message.octets.empty())
      self->send(vehicle, std::move(message));
  }

  void on_word(const messages::its_pdu& message) {
    if (!messages::etsi::decode(message.view(), word))
      return;
    const auto t = now(self);
    const auto said = messages::read_word(word, *world->where, t);
    if (!said || protocol::is_of_future(said->at, t))
      return;
    auto drive = drive_of(*said, world->where->frame, world->car.rear_m);
    planners::crossing_claim claim{said->from, said->at, std::nullopt};
    if (is_claim(*said) && !drive.empty())
      claim.drive = drive;
    member->on_report(t, claim, drive, said->reference);
    record_past();
  }

  void record_past() {
    if (const auto x = member->take_past())
      send_record(self, recorder,
                  messages::claim_record{station, lane, x->claimed, x->bound,
                                         x->enters, x->leaves, x->was_kept});
  }

  const world::route& way() const { return road->line.way(); }
};

messages::crossing_driver_actor::behavior_type crossing_driver(
    messages::crossing_driver_actor::stateful_pointer<crossing_driver_state>
        self,
    const messages::vehicle_actor& vehicle, station_id station,
    planners::route_profile_ptr road, messages::recorder_actor recorder,
    crossing_world_ptr world, duration input_period) {
  auto& state = self->state;
  state.self = self;
  state.vehicle = vehicle;
  state.station = station;
  state.member.emplace(station, world->car);
  state.ways.emplace(world->lanes,
                     planners::crossing_ways::area{world->options.centre,
                                                   world->options.radius_m},
                     world->car);
  state.road = std::move(road);
  state.recorder = std::move(recorder);
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
      [self](point, const messages::its_pdu& message) {
        self->state.on_word(message);
      },
  };
}

} // namespace

messages::crossing_driver_actor spawn_crossing_driver(const client_place& where,
                                                      crossing_world_ptr world,
                                                      duration input_period) {
  return where.system.spawn(crossing_driver, where.vehicle, where.station,
                            where.road, where.recorder, std::move(world),
                            input_period);
}

} // namespace sofof::actors
