// What a vehicle sends and to whom: road, recorder, and everybody near.
#include "actors/simulation/vehicle_links.hpp"

#include "actors/runtime/record_on_air.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "base/protocol.hpp"

#include <caf/exit_reason.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <utility>

namespace sofof::actors {

vehicle_links::vehicle_links(vehicle_impl::pointer self,
                             const vehicle_setup& setup)
    : self_{self}, setup_{setup} {
  if (setup.v2x)
    due_.emplace(*setup.v2x, setup.car.car, setup.sensor, setup.where);
}

void vehicle_links::ask_for_place(const driven_car& car) {
  self_->send(setup_.road, messages::begin_atom_v, car.report(),
              messages::vehicle_actor{self_});
}

void vehicle_links::report(const driven_car& car) {
  if (setup_.place)
    setup_.place->tell(car.position());
  self_->send(setup_.road, car.report(), messages::vehicle_actor{self_});
  if (!agent_)
    return;
  self_->send(agent_, messages::payload::of(car.drive()));
  if (setup_.air)
    self_->send(setup_.air, setup_.car.station.value(), car.position(),
                caf::actor_cast<messages::air_listener_actor>(agent_));
}

void vehicle_links::leave_road() {
  self_->send(setup_.road, setup_.car.station.value());
  if (setup_.rider)
    self_->send_exit(setup_.rider, caf::exit_reason::user_shutdown);
}

void vehicle_links::publish(
    const messages::ego_state& own, const world::perception& seen, point from,
    const messages::onboard_requester_actor& requester) {
  self_->send(requester, own);
  if (setup_.rider)
    self_->send(setup_.rider, own);
  if (!due_)
    return;
  send(due_->awareness(own.own), from, requester);
  send(due_->perceived(own.own, seen), from, requester);
}

// Its sensor is in the middle of its body.
void vehicle_links::show(const world::perception& seen, const driven_car& car) {
  if (!setup_.rider)
    return;
  const auto box = world::body(car.report().state, setup_.car.car);
  self_->send(setup_.rider,
              messages::roadside_detections{seen.at,
                                            seen.objects,
                                            0,
                                            {box.centre, box.heading_rad,
                                             setup_.sensor.range_m,
                                             setup_.sensor.field_of_view_deg}});
}

void vehicle_links::send(const std::optional<messages::its_pdu>& message,
                         point from,
                         const messages::onboard_requester_actor& requester) {
  if (!message || message->octets.empty())
    return;
  record_on_air(self_, setup_.recorder, *message);
  if (setup_.rider) // which has nobody to offer anything to
    self_->send(setup_.rider, *message, messages::requester_actor{});
  if (!setup_.antennas)
    return;
  for (std::size_t k = 0; k < setup_.antennas->size(); ++k) {
    if ((*setup_.antennas)[k].hears(setup_.car.station, from))
      self_->send(link(k), *message, messages::requester_actor{requester});
  }
}

const messages::link_actor& vehicle_links::link(std::size_t antenna) {
  auto& made = links_[antenna];
  if (!made)
    made = setup_.connect(antenna);
  return made;
}

void vehicle_links::say(const messages::its_pdu& word, point from,
                        const messages::onboard_requester_actor& requester) {
  if (!requester)
    return;
  send(word, from, requester);
  if (setup_.air)
    self_->send(setup_.air, setup_.car.station.value(), from, word);
}

// Each stage feeds the next, and the last one the planner.
void vehicle_links::join_stages() {
  if (!planner_)
    return;
  first_ = planner_;
  for (auto i = stages_.rbegin(); i != stages_.rend(); ++i) {
    self_->send(i->second, first_);
    first_ = i->second;
  }
}

void vehicle_links::ask(messages::service_input input, time_point sensed_at) {
  // Without a plan, looks are kept for as long as one may still answer them.
  std::erase_if(looks_, [=](const messages::sensor_look& x) {
    return x.sensed_at < sensed_at - messages::look_lasts;
  });
  looks_.push_back({sensed_at, input.at});
  self_->send(first_, std::move(input));
}

void vehicle_links::go_by(const received_plan& next,
                          const messages::service_result& from,
                          driven_car& car) {
  const auto t = now(self_);
  if (const auto jump = car.use(next, from, t))
    send_record(self_, setup_.recorder, *jump);
  if (car.goes_by(*next.plan))
    send_record(self_, setup_.recorder,
                messages::stage_record{setup_.car.station, from.session.service,
                                       from.session.provider, t, from.timing,
                                       car.at() + protocol::control_period,
                                       std::exchange(looks_, {})});
}

void vehicle_links::log_event(messages::event_type what) {
  send_record(self_, setup_.recorder,
              messages::event_record{.at = now(self_),
                                     .what = what,
                                     .station = setup_.car.station});
}

void vehicle_links::record(const driven_car& car, bool remote) {
  send_record(self_, setup_.recorder, car.track(remote));
}

void vehicle_links::record_figures(driven_car& car) {
  send_record(self_, setup_.recorder, car.flush_safety());
  send_record(self_, setup_.recorder, car.flush_figures());
}

void vehicle_links::record_trip(driven_car& car) {
  record_figures(car);
  send_record(self_, setup_.recorder, car.trip());
}

} // namespace sofof::actors
