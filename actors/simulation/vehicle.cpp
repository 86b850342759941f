// A car's actor: mailbox and timer; how it moves is in driven_car.
#include "actors/simulation/vehicle.hpp"

#include "actors/runtime/time.hpp"
#include "actors/simulation/vehicle_links.hpp"
#include "base/protocol.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

struct vehicle_actor_state {
  static inline const char* name = "vehicle";

  vehicle_impl::stateful_pointer<vehicle_actor_state> self;
  vehicle_setup setup;
  std::optional<vehicle_links> links;
  std::optional<driven_car> car;
  messages::onboard_requester_actor requester;
  messages::payload agreed; // at a crossing
  world::perception newest; // of what it perceives
  bool remote = false;
  bool has_arrived = false;
  std::optional<caf::error> leaving; // why

  void start() {
    links.emplace(self, setup);
    car.emplace(setup.car);
    if (setup.appears_after > 0ms)
      send_after(self, self, setup.appears_after, messages::tick_atom_v);
    else
      on_place();
  }

  // Before it is there, it asks to be.
  void on_tick() {
    if (car->has_appeared())
      go_on();
    else
      links->ask_for_place(*car);
  }

  void on_place() {
    if (setup.appears_after > 0ms)
      links->log_event(messages::event_type::appeared);
    car->appear(now(self));
    requester = setup.spawn_requester(messages::vehicle_actor{self});
    self->monitor(requester); // the car outlives it, and stops safely
    links->report(*car);
    go_on();
  }

  // -- ending -------------------------------------------------------------

  // The requester goes first: it has episodes to close.
  void on_exit(const caf::error& reason) {
    catch_up();
    if (car->has_appeared() && !has_arrived)
      links->record_trip(*car);
    leaving = reason;
    if (requester)
      self->send_exit(requester, reason);
    else
      self->quit(reason);
  }

  // At the end of an open route: makes room for others.
  void arrive() {
    has_arrived = true;
    links->log_event(messages::event_type::arrived);
    links->record_trip(*car);
    links->leave_road();
    if (requester)
      self->send_exit(requester, caf::exit_reason::user_shutdown);
  }

  void on_requester_down() {
    requester = nullptr;
    links->tell({});
    if (leaving)
      self->quit(*leaving);
    else if (!has_arrived)
      links->log_event(messages::event_type::requester_lost);
  }

  // -- moving -------------------------------------------------------------

  void go_on() {
    catch_up();
    if (!has_arrived)
      send_at(self, self, car->next_report(), messages::tick_atom_v);
  }

  // Moves up to now. Nobody sees the car between its reports, so it does so
  // when one is due, and before anything changes.
  void catch_up() {
    const auto t = now(self);
    while (car->has_appeared() && !has_arrived
           && t - car->at() >= protocol::control_period) {
      if (car->is_at_the_end())
        arrive();
      else
        move();
    }
  }

  void move() {
    const auto due = car->move();
    if (due.sensing) {
      links->report(*car);
      car->count_off_road();
    }
    if (due.telling)
      publish();
    if (due.track)
      links->record(*car, remote);
    if (due.figures)
      links->record_figures(*car);
  }

  void on_perception(world::perception& others) {
    newest = std::move(others); // a report of this moment tells of it
    catch_up();
    if (requester && !has_arrived)
      links->show(newest, *car);
    if (!links->is_planned_for() || !setup.plans || has_arrived)
      return;
    const auto from = car->plan_from(now(self));
    links->ask({{},
                from.at,
                setup.plans->ask(*setup.car.way, from, newest, car->ego().own,
                                 agreed)},
               newest.at);
  }

  void on_result(const messages::service_result& result) {
    catch_up();
    if (const auto next =
            setup.plans ? setup.plans->read(result) : std::nullopt)
      links->go_by(*next, result, *car);
  }

  void on_source(const messages::source_change& change) {
    catch_up();
    remote = change.remote;
  }

  void publish() {
    if (requester)
      links->publish(car->ego(), newest, car->position(), requester);
  }
};

vehicle_impl::behavior_type
vehicle(vehicle_impl::stateful_pointer<vehicle_actor_state> self,
        vehicle_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.start();
  self->set_down_handler(
      [self](const caf::down_msg&) { self->state.on_requester_down(); });
  self->set_exit_handler(
      [self](const caf::exit_msg& exit) { self->state.on_exit(exit.reason); });
  auto* const links = &*self->state.links;
  return {
      [self](const messages::service_result& x) { self->state.on_result(x); },
      [self](const messages::source_change& x) { self->state.on_source(x); },
      [links](const messages::requester_manager_actor& x) { links->join(x); },
      [links](std::uint32_t place, const messages::chain_stage_actor& stage) {
        links->join(place, stage);
      },
      [links](const messages::crossing_driver_actor& x) { links->tell(x); },
      [self](const messages::payload& agreed) { self->state.agreed = agreed; },
      [self](const messages::its_pdu& word) {
        auto& x = self->state;
        x.links->say(word, x.car->position(), x.requester);
      },
      [self](world::perception& others) { self->state.on_perception(others); },
      [self](messages::begin_atom) { self->state.on_place(); },
      [self](messages::tick_atom) { self->state.on_tick(); },
  };
}

} // namespace

messages::vehicle_actor spawn_vehicle(caf::actor_system& sys,
                                      vehicle_setup setup) {
  return sys.spawn(vehicle, std::move(setup));
}

} // namespace sofof::actors
