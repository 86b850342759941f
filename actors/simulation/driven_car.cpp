// A car that follows plans: how it moves, and what it is never without.
#include "actors/simulation/driven_car.hpp"

#include "base/protocol.hpp"
#include "planners/scene/lane_motion.hpp"
#include "planners/speed/lone_drive.hpp"
#include "planners/trajectory/keep_speed.hpp"
#include "planners/trajectory/safe_stop.hpp"
#include "world/traffic/on_road.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// A plan that ends sooner than this is replaced by a safe stop.
constexpr duration reserve = 1s;
/// Plans that came by air begin at a whole millisecond, up to one late.
constexpr duration air_time_step = 1ms;
/// A plan is followed well while the car is no farther from it than this.
constexpr double followed_m = 1.0;
constexpr double followed_mps = 1.5;
/// A car is sought on its route only so far from where it should be.
constexpr double window_m = 2;
/// A car that is so near the end of its route has arrived. It leaves before it
/// stops there, or those behind it would queue up.
constexpr double at_the_end_m = 10.0;
/// Safety and comfort are summed up so often.
constexpr duration figures_period = 1s;

} // namespace

driven_car::driven_car(car_setup setup)
    : setup_{std::move(setup)}, s_m_{setup_.start_s_m} {
  const auto p = setup_.way->path().frame(s_m_);
  car_.at = p.at + lateral_m_ * point{-p.tangent.y_m, p.tangent.x_m};
  car_.heading_rad = p.heading_rad + setup_.start_turn_rad;
  car_.speed_mps = setup_.start_speed_mps;
  safety_.station = setup_.station;
}

void driven_car::appear(time_point now) {
  at_ = plan_created_ = now;
  figures_.emplace(setup_.station, setup_.car, car_.speed_mps);
  plan_ = std::make_shared<const world::trajectory>(
      planners::keep_speed(*setup_.way, now, s_m_, car_.speed_mps));
}

// -- moving -----------------------------------------------------------------

driven_car::due driven_car::move() {
  assert(has_appeared());
  const auto next = at_ + protocol::control_period;
  if (plan_->end() - next < reserve || is_left_alone(next))
    stop_safely(next);
  const auto command = world::follow(car_, *plan_, next, setup_.car);
  const auto dt_s = to_seconds(protocol::control_period);
  car_ = world::step(car_, command, setup_.car, dt_s);
  at_ = next;
  const auto place = setup_.way->path().project(
      car_.at, s_m_ + car_.speed_mps * dt_s, window_m);
  s_m_ = place.s_m;
  lateral_m_ = place.d_m;
  ++steps_;
  count_safety();
  figures_->on_step(car_);
  return {.sensing = ends(protocol::sensor_period, steps_),
          .telling = ends(protocol::ego_period, steps_),
          .track = is_tracked(steps_),
          .figures = ends(figures_period, steps_)};
}

time_point driven_car::next_report() const {
  static_assert(protocol::sensor_period % protocol::control_period == 0ms);
  static_assert(protocol::ego_period % protocol::sensor_period == 0ms);
  static_assert(figures_period % protocol::sensor_period == 0ms);
  auto next = steps_ + 1;
  while (!ends(protocol::sensor_period, next) && !is_tracked(next))
    ++next;
  return at_ + (next - steps_) * protocol::control_period;
}

bool driven_car::is_at_the_end() const {
  return !setup_.way->closed()
         && s_m_ + setup_.car.front_m + at_the_end_m >= setup_.way->length_m();
}

bool driven_car::is_tracked(std::uint64_t step) const {
  return setup_.track_period > 0ms && ends(setup_.track_period, step);
}

// Whether a period ends with a step. Stations take turns, so that not
// everybody sends in the same moment.
bool driven_car::ends(duration period, std::uint64_t step) const {
  const auto n = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(period / protocol::control_period));
  return (step + setup_.station.value()) % n == 0;
}

// -- plans ------------------------------------------------------------------

void driven_car::stop_safely(time_point from) {
  stops_safely_ = true;
  figures_->stop_safely();
  plan_ = std::make_shared<const world::trajectory>(
      planners::safe_stop(*setup_.way, from, measured()));
}

std::optional<messages::plan_switch_record>
driven_car::use(const received_plan& next, const messages::service_result& from,
                time_point now) {
  assert(has_appeared() && next.plan);
  if (from.created < plan_created_ || !next.plan->is_sound())
    return std::nullopt;
  if (from.created > now || next.plan->start > now + air_time_step
      || next.plan->end() < now)
    return std::nullopt; // of another time
  auto jump =
      figures_->on_plan(*plan_, *next.plan, next.report, from.session, now);
  plan_ = next.plan;
  plan_created_ = from.created;
  stops_safely_ = false;
  return jump;
}

planners::planning_input driven_car::plan_from(time_point now) const {
  assert(has_appeared());
  const auto p = plan_->at(now);
  if (distance_m(p.at, car_.at) > followed_m
      || std::abs(p.speed_mps - car_.speed_mps) > followed_mps)
    return measured();
  auto from = planners::seen_from(*setup_.way, p);
  from.at = now;
  return from;
}

planners::planning_input driven_car::measured() const {
  const auto& path = setup_.way->path();
  const auto place = path.project(car_.at, s_m_, window_m);
  return {at_,
          place.s_m,
          place.d_m,
          wrap_angle(car_.heading_rad - path.at(place.s_m).heading_rad),
          std::tan(car_.steer_rad) / setup_.car.wheelbase_m,
          car_.speed_mps,
          car_.accel_mps2,
          {}};
}

// -- what others see of it --------------------------------------------------

own_drive driven_car::drive() const {
  return {ego().own, s_m_, plan_};
}

messages::ego_state driven_car::ego() const {
  return {{setup_.station, at_, car_.at, car_.heading_rad, car_.speed_mps,
           car_.accel_mps2, std::tan(car_.steer_rad) / setup_.car.wheelbase_m},
          s_m_};
}

messages::track_record driven_car::track(bool remote) const {
  return {at_, ego(), lateral_m_, at_ - plan_created_, remote, plan_};
}

void driven_car::count_off_road() {
  if (!world::is_on_road(*setup_.way, s_m_, car_, setup_.car))
    safety_.off_road += protocol::sensor_period;
}

void driven_car::count_safety() {
  const auto age = at_ - plan_created_;
  safety_.driven += protocol::control_period;
  safety_.max_plan_age = std::max(safety_.max_plan_age, age);
  if (age > setup_.fresh_limit)
    safety_.without_fresh_plan += protocol::control_period;
}

messages::trip_record driven_car::trip() const {
  assert(has_appeared());
  const auto& stops = figures_->stops();
  return {setup_.station,
          {to_seconds(static_cast<duration::rep>(steps_)
                      * protocol::control_period),
           planners::lone_drive_s(*setup_.road, {}, setup_.start_s_m,
                                  setup_.start_speed_mps, s_m_),
           stops.count(), stops.longest_s(), is_at_the_end()}};
}

messages::safety_record driven_car::flush_safety() {
  return std::exchange(safety_, {.station = setup_.station});
}

} // namespace sofof::actors
