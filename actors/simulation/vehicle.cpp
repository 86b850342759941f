// A car: moves, sends CAMs, follows the trajectories it is given.
#include "actors/simulation/vehicle.hpp"

#include "actors/runtime/on_air.hpp"
#include "actors/runtime/recorder.hpp"
#include "actors/runtime/time.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/simulation/drive_figures.hpp"
#include "actors/simulation/v2x_broadcast.hpp"
#include "base/protocol.hpp"
#include "planners/scene/lane_motion.hpp"
#include "planners/trajectory/keep_speed.hpp"
#include "planners/trajectory/safe_stop.hpp"

#include <caf/stateful_actor.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace sofof {

namespace {

using namespace std::chrono_literals;

using vehicle_impl = vehicle_actor::extend<reacts_to<tick_atom>>;

/// A plan that ends sooner than this is replaced by a safe stop.
constexpr duration reserve = 1s;
/// Plans that came by air begin at a whole millisecond, up to one late.
constexpr duration air_time_step = 1ms;
/// A plan is followed well while the car is no farther from it than this.
constexpr double followed_m = 1.0;
constexpr double followed_mps = 1.5;
/// A car is sought on its route only so far from where it should be.
constexpr double window_m = 2;
/// A car that stands so near the end of its route has arrived.
constexpr double at_the_end_m = 1.0;
/// Safety and comfort are summed up so often.
constexpr duration figures_period = 1s;

struct vehicle_actor_state {
  static inline const char* name = "vehicle";

  vehicle_impl::stateful_pointer<vehicle_actor_state> self;
  vehicle_setup setup;
  onboard_requester_actor requester;
  requester_manager_actor planning; // gets the inputs
  vehicle_state car;
  double s_m = 0;
  std::shared_ptr<const trajectory> plan;
  time_point plan_created;
  bool remote = false;
  bool has_arrived = false;
  std::optional<caf::error> leaving; // why
  time_point car_at;                 // of its state; it does not drift
  std::uint64_t steps = 0;
  safety_record safety;
  std::optional<drive_figures> figures; // from when it appears on
  std::optional<v2x_broadcast> broadcast;
  perception newest; // of what it perceives

  void start() {
    const auto p = setup.way->path().at(setup.start_s_m);
    car.at = p.at;
    car.heading_rad = p.heading_rad;
    car.speed_mps = setup.start_speed_mps;
    s_m = setup.start_s_m;
    if (setup.appears_after > 0ms)
      send_after(self, self, setup.appears_after, tick_atom_v);
    else
      appear();
  }

  // What it does of itself: before it is there, it asks to be.
  void act() {
    if (figures)
      go_on();
    else
      self->send(setup.road, begin_atom_v,
                 motion_report{setup.station, s_m, car}, vehicle_actor{self});
  }

  void appear() {
    if (setup.appears_after > 0ms)
      note(event_type::appeared);
    car_at = now(self);
    figures.emplace(setup.station, setup.car, car.speed_mps);
    plan = std::make_shared<const trajectory>(
        keep_speed(*setup.way, car_at, s_m, car.speed_mps));
    plan_created = car_at;
    safety.station = setup.station;
    if (setup.v2x)
      broadcast.emplace(*setup.v2x, setup.car, setup.sensor, setup.where);
    requester = setup.spawn_requester(vehicle_actor{self});
    self->monitor(requester); // the car outlives it, and stops safely
    report();
    go_on();
  }

  // -- ending -------------------------------------------------------------

  // The requester goes first: it has episodes to close.
  void leave(const caf::error& reason) {
    catch_up();
    if (figures)
      flush_figures();
    leaving = reason;
    if (requester)
      self->send_exit(requester, reason);
    else
      self->quit(reason);
  }

  // At the end of an open route: makes room for others.
  bool is_at_the_end() const {
    return !setup.way->closed() && car.speed_mps <= 0
           && s_m + setup.car.front_m + at_the_end_m >= setup.way->length_m();
  }

  void arrive() {
    has_arrived = true;
    note(event_type::arrived);
    flush_figures();
    self->send(setup.road, setup.station);
    if (requester)
      self->send_exit(requester, caf::exit_reason::user_shutdown);
  }

  void note(event_type what) {
    send_record(self, setup.recorder,
                event_record{now(self), what, setup.station, 0, {}, 0, {}});
  }

  void requester_gone() {
    requester = nullptr;
    if (leaving)
      self->quit(*leaving);
    else if (!has_arrived)
      note(event_type::requester_lost);
  }

  // -- moving -------------------------------------------------------------

  void go_on() {
    catch_up();
    if (!has_arrived)
      send_at(self, self, next_report(), tick_atom_v);
  }

  // Moves up to now. Nobody sees the car between its reports, so it does so
  // when one is due, and before anything changes.
  void catch_up() {
    const auto t = now(self);
    while (figures && !has_arrived && t - car_at >= protocol::control_period)
      move();
  }

  void move() {
    if (is_at_the_end()) {
      arrive();
      return;
    }
    const auto next = car_at + protocol::control_period;
    if (plan->end() - next < reserve)
      stop_safely(next);
    const auto command = follow(car, *plan, next, setup.car);
    const auto dt_s = to_seconds(protocol::control_period);
    car = step(car, command, setup.car, dt_s);
    car_at = next;
    const auto place =
        setup.way->path().project(car.at, s_m + car.speed_mps * dt_s, window_m);
    s_m = place.s_m;
    ++steps;
    keep_safety();
    figures->on_step(car);
    if (ends(protocol::sensor_period, steps))
      sense(place.d_m);
    if (ends(protocol::ego_period, steps))
      tell();
    if (is_tracked(steps))
      send_record(self, setup.recorder,
                  track_record{car_at, ego(), place.d_m, car_at - plan_created,
                               remote});
    if (ends(figures_period, steps))
      flush_figures();
  }

  time_point next_report() const {
    static_assert(protocol::sensor_period % protocol::control_period == 0ms);
    static_assert(protocol::ego_period % protocol::sensor_period == 0ms);
    static_assert(figures_period % protocol::sensor_period == 0ms);
    auto next = steps + 1;
    while (!ends(protocol::sensor_period, next) && !is_tracked(next))
      ++next;
    return car_at + (next - steps) * protocol::control_period;
  }

  bool is_tracked(std::uint64_t step) const {
    return setup.track_period > 0ms && ends(setup.track_period, step);
  }

  // Whether a period ends with a step. Stations take turns, so that not
  // everybody sends in the same moment.
  bool ends(duration period, std::uint64_t step) const {
    const auto n = std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(period / protocol::control_period));
    return (step + setup.station) % n == 0;
  }

  void stop_safely(time_point from) {
    figures->stop_safely();
    plan = std::make_shared<const trajectory>(
        safe_stop(*setup.way, from, measured()));
  }

  // -- the others ---------------------------------------------------------

  void report() {
    self->send(setup.road, motion_report{setup.station, s_m, car},
               vehicle_actor{self});
  }

  void sense(double lateral_m) {
    report();
    const auto front = setup.way->path().project(
        car.at
            + setup.car.wheelbase_m
                  * point{std::cos(car.heading_rad), std::sin(car.heading_rad)},
        s_m + setup.car.wheelbase_m, window_m);
    const auto outermost_m = std::max(std::abs(lateral_m), std::abs(front.d_m))
                             + setup.car.width_m / 2;
    if (outermost_m > setup.way->half_width_m(s_m))
      safety.off_road += protocol::sensor_period;
  }

  void on_perception(perception& others) {
    newest = std::move(others); // a report of this moment tells of it
    catch_up();
    if (!planning || has_arrived)
      return;
    plan_request request{setup.way->name(), anchor(), newest, ego().own};
    const auto at = request.from.at;
    self->send(planning,
               service_input{{}, at, payload::of(std::move(request))});
  }

  // Where to plan from: the point of the plan in use if the car is there,
  // so that plans join without a jolt, else the car.
  planning_input anchor() const {
    const auto t = now(self);
    const auto p = plan->at(t);
    if (distance_m(p.at, car.at) > followed_m
        || std::abs(p.speed_mps - car.speed_mps) > followed_mps)
      return measured();
    auto from = seen_from(*setup.way, p);
    from.at = t;
    return from;
  }

  planning_input measured() const {
    const auto& path = setup.way->path();
    const auto place = path.project(car.at, s_m, window_m);
    return {car_at,
            place.s_m,
            place.d_m,
            wrap_angle(car.heading_rad - path.at(place.s_m).heading_rad),
            std::tan(car.steer_rad) / setup.car.wheelbase_m,
            car.speed_mps,
            car.accel_mps2,
            {}};
  }

  // -- plans --------------------------------------------------------------

  void on_result(const service_result& result) {
    catch_up();
    if (result.created < plan_created)
      return;
    const auto t = now(self);
    const auto next = result.what.as<trajectory>();
    if (!next || !next->is_sound())
      return;
    const auto about = result.about.as<plan_report>();
    if (result.created > t || next->start > t + air_time_step
        || next->end() < t)
      return; // of another time
    if (const auto other = figures->on_plan(
            *plan, *next, about ? *about : plan_report{}, result.running, t))
      send_record(self, setup.recorder, *other);
    plan = next;
    plan_created = result.created;
  }

  void on_source(const source_change& change) {
    catch_up();
    remote = change.remote;
  }

  // -- being seen ---------------------------------------------------------

  ego_state ego() const {
    return {{setup.station, car_at, car.at, car.heading_rad, car.speed_mps,
             car.accel_mps2, std::tan(car.steer_rad) / setup.car.wheelbase_m},
            s_m};
  }

  void tell() {
    if (!requester)
      return;
    const auto own = ego();
    self->send(requester, own);
    if (!broadcast)
      return;
    send(broadcast->awareness(own.own));
    send(broadcast->perceived(own.own, newest));
  }

  // To everybody who is near enough.
  void send(const std::optional<its_pdu>& message) {
    if (!message || message->octets.empty())
      return;
    note_on_air(self, setup.recorder, *message);
    for (const auto& a : setup.antennas)
      if (distance_m(car.at, a.position) <= a.range_m)
        self->send(a.link, *message, requester_actor{requester});
  }

  void keep_safety() {
    const auto age = car_at - plan_created;
    safety.driven += protocol::control_period;
    safety.max_plan_age = std::max(safety.max_plan_age, age);
    if (age > setup.fresh_limit)
      safety.without_fresh_plan += protocol::control_period;
  }

  void flush_figures() {
    send_record(self, setup.recorder, safety);
    send_record(self, setup.recorder, figures->flush());
    safety = {};
    safety.station = setup.station;
  }
};

vehicle_impl::behavior_type
vehicle(vehicle_impl::stateful_pointer<vehicle_actor_state> self,
        vehicle_setup setup) {
  self->state.self = self;
  self->state.setup = std::move(setup);
  self->state.start();
  self->set_down_handler(
      [self](const caf::down_msg&) { self->state.requester_gone(); });
  self->set_exit_handler(
      [self](const caf::exit_msg& exit) { self->state.leave(exit.reason); });
  return {
      [self](const service_result& result) { self->state.on_result(result); },
      [self](const source_change& change) { self->state.on_source(change); },
      [self](const requester_manager_actor& manager) {
        self->state.planning = manager;
      },
      [self](perception& others) { self->state.on_perception(others); },
      [self](begin_atom) { self->state.appear(); },
      [self](tick_atom) { self->state.act(); },
  };
}

} // namespace

vehicle_actor spawn_vehicle(caf::actor_system& sys, vehicle_setup setup) {
  return sys.spawn(vehicle, std::move(setup));
}

} // namespace sofof
