// What a vehicle sends and to whom: road, recorder, and everybody near.
#pragma once

#include "actors/simulation/v2x_broadcast.hpp"
#include "actors/simulation/vehicle.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

/// A vehicle itself; besides its interface: its timer.
using vehicle_impl =
    messages::vehicle_actor::extend<messages::reacts_to<messages::tick_atom>>;

/// Turns what a vehicle does into messages of its actor.
class vehicle_links {
public:
  /// @param self, setup  Outlive the links.
  vehicle_links(vehicle_impl::pointer self, const vehicle_setup& setup);

  /// The road is asked for the vehicle's place.
  void ask_for_place(const driven_car& car);
  /// Road and agent are told where the vehicle is.
  void report(const driven_car& car);
  /// The road has one vehicle less, and the providers one that rode with it.
  void leave_road();

  /// Tells its requester and the provider that rides with it where the vehicle
  /// is, and all providers that are near enough of it and of what it saw last,
  /// as far as that is due.
  /// @param requester  Who gets what they answer; not null.
  void publish(const messages::ego_state& own, const world::perception& seen,
               point from, const messages::onboard_requester_actor& requester);

  /// Shows the provider that rides with it what the vehicle sees.
  void show(const world::perception& seen, const driven_car& car);

  /// Tells providers and vehicles near.
  void say(const messages::its_pdu& word, point from,
           const messages::onboard_requester_actor& requester);

  /// @param agent  Agrees with others for the vehicle: told from now on what
  ///               the road is told, and by it the vehicle hears. Null: nobody.
  void tell(messages::crossing_driver_actor agent) {
    agent_ = std::move(agent);
  }

  /// Who plans for the vehicle.
  void join(messages::requester_manager_actor planner) {
    planner_ = std::move(planner);
    join_stages();
  }
  /// At this place of the chain before that there is another service.
  void join(std::uint32_t place, messages::chain_stage_actor stage) {
    stages_[place] = std::move(stage);
    join_stages();
  }
  bool is_planned_for() const { return first_ != nullptr; }
  /// The first of the chain has new input.
  /// @param sensed_at  When what is in it was seen.
  void ask(messages::service_input input, time_point sensed_at);
  /// The last one has a plan: the car goes by it if it can.
  void go_by(const received_plan& next, const messages::service_result& from,
             driven_car& car);

  void log_event(messages::event_type what);
  void record(const driven_car& car, bool remote);
  void record_figures(driven_car& car);
  /// Its drive ends: the rest of its figures, and its trip.
  void record_trip(driven_car& car);

private:
  void join_stages();
  const messages::link_actor& link(std::size_t antenna);
  void send(const std::optional<messages::its_pdu>& message, point from,
            const messages::onboard_requester_actor& requester);

  vehicle_impl::pointer self_;
  const vehicle_setup& setup_;
  std::optional<v2x_broadcast> due_; // none if it is not connected
  std::map<std::size_t, messages::link_actor> links_; // by antenna, as made
  messages::crossing_driver_actor agent_;
  messages::requester_manager_actor planner_;
  std::map<std::uint32_t, messages::chain_stage_actor> stages_;
  messages::input_actor first_;              // of these
  std::vector<messages::sensor_look> looks_; // since the last plan
};

} // namespace sofof::actors
