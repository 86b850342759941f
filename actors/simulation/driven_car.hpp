// A car that follows plans: how it moves, and what it is never without.
#pragma once

#include "actors/simulation/drive_figures.hpp"
#include "actors/simulation/plan_client.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/record.hpp"
#include "planners/speed/route_profile.hpp"
#include "world/roads/road_map.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>

namespace sofof::actors {

/// Where and as what a car starts.
struct car_setup {
  station_id station = 0;
  world::route_ptr way;
  double start_s_m = 0;
  double start_speed_mps = 0;
  world::vehicle_params car;
  duration fresh_limit{};           ///< Plans older than this are not fresh.
  duration alone_limit{};           ///< Older ones are not followed to their
                                    ///< end; zero: all are.
  duration track_period{};          ///< Between two track records; zero: none.
  planners::route_profile_ptr road; ///< Of `way`, as comfort has it by default.
  double start_left_m = 0;          ///< Of the middle of the lane,
  double start_turn_rad = 0;        ///< and from its direction to the left.
};

/// Where a car is, and how it is going to drive.
struct own_drive {
  messages::cam own;
  double s_m = 0; ///< Rear axle on its route, laps included.
  std::shared_ptr<const world::trajectory> plan; ///< In use; not null.
};

/// The plan is left out: it stays in the vehicle.
void visit_fields(auto& v, own_drive& x) {
  v("own", x.own);
  v("s_m", x.s_m);
}

/// Steps the car at protocol::control_period along the plan in use. It begins
/// with a plan to keep its speed, and when a plan is about to end without a
/// successor, or is too old to be followed any more, it makes a safe stop of
/// its own: it never is without a plan.
class driven_car {
public:
  explicit driven_car(car_setup setup);

  /// It is there from now on. Everything below wants that.
  void appear(time_point now);
  bool has_appeared() const { return figures_.has_value(); }

  /// What a step is the end of.
  struct due {
    bool sensing = false; ///< protocol::sensor_period.
    bool telling = false; ///< protocol::ego_period.
    bool track = false;
    bool figures = false;
  };

  /// Moves by one step.
  due move();
  /// @returns when it was moved to; it does not drift.
  time_point at() const { return at_; }
  /// @returns when the next step is due that others see or record.
  time_point next_report() const;
  /// At the end of an open route.
  bool is_at_the_end() const;

  /// Goes by another plan, if it is sound, newer, and of now.
  /// @returns the jump, if the plan so far is from another source.
  std::optional<messages::plan_switch_record>
  use(const received_plan& next, const messages::service_result& from,
      time_point now);

  bool goes_by(const world::trajectory& plan) const {
    return plan_.get() == &plan;
  }

  /// Where to plan from: the point of the plan in use if the car is there, so
  /// that plans join without a jolt, else the car.
  planners::planning_input plan_from(time_point now) const;

  messages::motion_report report() const {
    return {setup_.station, s_m_, car_};
  }
  messages::ego_state ego() const;
  /// @param remote  Whether its plans come from a provider.
  messages::track_record track(bool remote) const;
  point position() const { return car_.at; }
  own_drive drive() const;

  /// A step of protocol::sensor_period ends: counts it if the car is off its
  /// road.
  void count_off_road();
  /// @returns the figures since the last call.
  messages::safety_record flush_safety();
  messages::drive_record flush_figures() {
    assert(has_appeared());
    return figures_->flush();
  }

  /// @returns its trip so far.
  messages::trip_record trip() const;

private:
  planners::planning_input measured() const;
  bool ends(duration period, std::uint64_t step) const;
  bool is_tracked(std::uint64_t step) const;
  bool is_left_alone(time_point next) const {
    return !stops_safely_ && setup_.alone_limit > duration{}
           && next - plan_created_ > setup_.alone_limit;
  }
  void stop_safely(time_point from);
  void count_safety();

  car_setup setup_;
  world::vehicle_state car_;
  double s_m_ = 0;                         // of the rear axle on the route,
  double lateral_m_ = setup_.start_left_m; // and beside it
  time_point at_;
  std::uint64_t steps_ = 0;
  std::shared_ptr<const world::trajectory> plan_;
  time_point plan_created_;
  bool stops_safely_ = false;
  messages::safety_record safety_;
  std::optional<drive_figures> figures_; // from when it appears on
};

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::own_drive> = "own_drive";
