// What happened, for the results folder.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/service.hpp"
#include "world/vehicle/comfort.hpp"
#include "world/vehicle/ride_comfort.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Something worth a line in events.jsonl.
struct event_record {
  time_point at;
  std::string what; ///< offer, request, switch, …: docs/results.md.
  station_id station = 0;
  provider_id provider = 0;
  service_name kind; ///< Empty when it concerns no single service.
  std::uint32_t counter = 0;
  std::string detail; ///< Why, or how.
};

/// One requested service has been answered, or has not been in time.
struct decision_record {
  time_point at;
  station_id station = 0;
  service_name kind;
  bool accepted = false;
};

/// One received result of a remote service.
struct cycle_record {
  /// How far a result stayed within a limit of the vehicle's judge.
  struct margin {
    std::string name; ///< Of the check, with its unit.
    double left = 0;
  };

  session_id running;
  std::uint64_t cycle = 0;
  time_point created;
  time_point received;
  std::optional<duration> interarrival; ///< None for the first in use.
  bool used = false;
  duration doubt{};              ///< `created` may be off by this.
  std::vector<margin> margins{}; ///< If they are recorded.
};

/// One side has closed a running service.
struct episode_record {
  session_id running;
  side of = side::requester;
  time_point accepted;   ///< When the service was accepted.
  time_point first_data; ///< Requester: the switch to remote; else accepted.
  bool got_data = false;
  time_point ended;
  end_reason reason = end_reason::shutdown;
  bool fallback = false; ///< Requester: the local service had to jump in.
};

/// Where a vehicle is, and how old the plan is that it follows.
struct track_record {
  time_point at;
  ego_state ego;
  double lateral_m = 0; ///< Offset of the rear axle from the lane's centre.
  duration plan_age{};
  bool remote = false;
};

/// How safely a vehicle drove since its last such record.
struct safety_record {
  station_id station = 0;
  duration driven{};
  duration without_fresh_plan{};
  duration off_road{};
  duration max_plan_age{};
};

/// How smoothly a vehicle drove since its last such record.
struct drive_record {
  station_id station = 0;
  plan_figures plans;
  ride_figures ride;
};

/// A vehicle has taken its first plan from another source into use.
struct plan_switch_record {
  time_point at;
  session_id running;  ///< Its remote side, the new or the former one.
  bool remote = false; ///< Where the new plan comes from.
  plan_jump jump;
};

/// An ITS message was sent, whoever may have got it.
struct air_record {
  time_point at;
  its_pdu message;
};

/// Two bodies have touched.
struct collision_record {
  time_point at;
  station_id first = 0, second = 0;
};

template <class Inspector>
bool inspect(Inspector& f, event_record& x) {
  return f.object(x).fields(
      f.field("at", x.at), f.field("what", x.what),
      f.field("station", x.station), f.field("provider", x.provider),
      f.field("kind", x.kind), f.field("counter", x.counter),
      f.field("detail", x.detail));
}

template <class Inspector>
bool inspect(Inspector& f, decision_record& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("station", x.station),
                            f.field("kind", x.kind),
                            f.field("accepted", x.accepted));
}

template <class Inspector>
bool inspect(Inspector& f, cycle_record::margin& x) {
  return f.object(x).fields(f.field("name", x.name), f.field("left", x.left));
}

template <class Inspector>
bool inspect(Inspector& f, cycle_record& x) {
  return f.object(x).fields(
      f.field("running", x.running), f.field("cycle", x.cycle),
      f.field("created", x.created), f.field("received", x.received),
      f.field("interarrival", x.interarrival), f.field("used", x.used),
      f.field("doubt", x.doubt), f.field("margins", x.margins));
}

template <class Inspector>
bool inspect(Inspector& f, episode_record& x) {
  return f.object(x).fields(
      f.field("running", x.running), f.field("of", x.of),
      f.field("accepted", x.accepted), f.field("first_data", x.first_data),
      f.field("got_data", x.got_data), f.field("ended", x.ended),
      f.field("reason", x.reason), f.field("fallback", x.fallback));
}

template <class Inspector>
bool inspect(Inspector& f, track_record& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("ego", x.ego),
                            f.field("lateral_m", x.lateral_m),
                            f.field("plan_age", x.plan_age),
                            f.field("remote", x.remote));
}

template <class Inspector>
bool inspect(Inspector& f, safety_record& x) {
  return f.object(x).fields(
      f.field("station", x.station), f.field("driven", x.driven),
      f.field("without_fresh_plan", x.without_fresh_plan),
      f.field("off_road", x.off_road), f.field("max_plan_age", x.max_plan_age));
}

template <class Inspector>
bool inspect(Inspector& f, motion_extremes& x) {
  return f.object(x).fields(f.field("lateral_accel_mps2", x.lateral_accel_mps2),
                            f.field("jerk_mps3", x.jerk_mps3),
                            f.field("min_accel_mps2", x.min_accel_mps2));
}

template <class Inspector>
bool inspect(Inspector& f, plan_figures& x) {
  return f.object(x).fields(
      f.field("count", x.count), f.field("emergency", x.emergency),
      f.field("kept", x.kept), f.field("stops", x.stops),
      f.field("imperfect", x.imperfect), f.field("safe_stops", x.safe_stops),
      f.field("extremes", x.extremes), f.field("on_board", x.on_board));
}

template <class Inspector>
bool inspect(Inspector& f, ride_figures& x) {
  return f.object(x).fields(
      f.field("distance_m", x.distance_m), f.field("extremes", x.extremes),
      f.field("hard_brakes", x.hard_brakes),
      f.field("comfort_cost_m2ps3", x.comfort_cost_m2ps3));
}

template <class Inspector>
bool inspect(Inspector& f, plan_jump& x) {
  return f.object(x).fields(
      f.field("d_m", x.d_m), f.field("curvature_1pm", x.curvature_1pm),
      f.field("speed_mps", x.speed_mps), f.field("accel_mps2", x.accel_mps2));
}

template <class Inspector>
bool inspect(Inspector& f, drive_record& x) {
  return f.object(x).fields(f.field("station", x.station),
                            f.field("plans", x.plans), f.field("ride", x.ride));
}

template <class Inspector>
bool inspect(Inspector& f, plan_switch_record& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("running", x.running),
                            f.field("remote", x.remote),
                            f.field("jump", x.jump));
}

template <class Inspector>
bool inspect(Inspector& f, collision_record& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("first", x.first),
                            f.field("second", x.second));
}

template <class Inspector>
bool inspect(Inspector& f, air_record& x) {
  return f.object(x).fields(f.field("at", x.at), f.field("message", x.message));
}

/// Takes the records of a run; implemented by whoever keeps them.
class record_sink {
public:
  virtual ~record_sink() = default;
  virtual void take(const event_record&) = 0;
  virtual void take(const decision_record&) = 0;
  virtual void take(const cycle_record&) = 0;
  virtual void take(const episode_record&) = 0;
  virtual void take(const track_record&) = 0;
  virtual void take(const safety_record&) = 0;
  virtual void take(const collision_record&) = 0;
  virtual void take(const drive_record&) = 0;
  virtual void take(const plan_switch_record&) = 0;
  virtual void take(const air_record&) = 0;
};

} // namespace sofof
