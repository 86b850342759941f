// What happened, for the results folder.
#pragma once

#include "messages/protocol/event_type.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/service.hpp"
#include "messages/protocol/trace.hpp"
#include "world/vehicle/plan_comfort.hpp"
#include "world/vehicle/ride_comfort.hpp"
#include "world/vehicle/trajectory.hpp"
#include "world/vehicle/trip.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sofof::messages {

/// Something worth a line in events.jsonl.
struct event_record {
  time_point at{};
  event_type what{};
  station_id station = 0;
  provider_id provider = 0;
  service_name service{}; ///< Empty when it concerns no single service.
  std::uint32_t counter = 0;
  std::string detail{}; ///< Why, or how, for people.
  bool remote = false;  ///< Of a switch: to a provider.
  std::string check{};  ///< Of an implausible result: the one that it failed.
};

/// One requested service has been answered, or has not been in time.
struct decision_record {
  time_point at;
  station_id station = 0;
  service_name service;
  bool accepted = false;
};

/// A provider has decided about one requested service.
struct verdict_record {
  time_point at;
  session_id session; ///< Counter 0 when refused.
  bool accepted = false;
  std::string why; ///< As it is told to the vehicle.
};

/// One received result of a remote service.
struct cycle_record {
  /// How far a result stayed within a limit of the vehicle's judge.
  struct margin {
    std::string name; ///< Of the check, with its unit.
    double left = 0;
  };

  session_id session;
  std::uint64_t cycle = 0;
  time_point created;
  time_point received;
  std::optional<duration> interarrival; ///< None for the first in use.
  bool used = false;
  duration doubt{}; ///< `created` may be off by this.
  result_timing timing{};
  std::vector<margin> margins{}; ///< If they are recorded.

  /// @returns of the time between input and arrival what no part of `timing`
  /// is: for that long the input waited for the cycle.
  duration rest() const {
    const auto& [input_at, up, queue, computing, down] = timing;
    return received - input_at - up.wait - up.travel - queue - computing
           - down.wait - down.travel;
  }
};

/// What a service of one vehicle has done since its last such record.
struct work_record {
  station_id station = 0;
  service_name service;
  std::uint64_t on_board = 0; ///< Results of its own function that it used.
  std::uint64_t inputs = 0;   ///< That it sent to providers.
  std::uint64_t along = 0; ///< Results of its own function that it did not use.
  // What that took, and what results took that were not used:
  std::uint64_t computed = 0;    ///< Results of its own function,
  duration computing{};          ///< and for how long it computed them.
  std::uint64_t received = 0;    ///< Results of providers.
  std::uint64_t octets_up = 0;   ///< On the air, of these inputs
  std::uint64_t octets_down = 0; ///< and results; 0 without actors.
  /// From the record before, or the begin, to this one. A change of the source
  /// is between two records.
  time_point since = time_point::min(), at{};

  bool is_empty() const {
    return on_board == 0 && inputs == 0 && along == 0 && computed == 0
           && received == 0;
  }
};

/// The `because` of an episode that the other side ended: the record of that
/// side has the rest.
inline constexpr std::string_view told_by_provider = "told by the provider";
inline constexpr std::string_view told_by_vehicle = "told by the vehicle";

/// @param because  As the vehicle records it.
/// @returns whether the end of the vehicle's drive, or of the run, ended an
/// episode; a provider that shuts down ends it, too, while the vehicle goes on.
inline bool is_cut_off(end_reason reason, std::string_view because) {
  return reason == end_reason::shutdown && because != told_by_provider;
}

/// One side has closed a session.
struct episode_record {
  session_id session;
  side of = side::requester;
  time_point accepted;   ///< When the service was accepted.
  time_point first_data; ///< Requester: the switch to remote; else accepted.
  bool got_data = false;
  time_point ended;
  end_reason reason = end_reason::shutdown;
  bool fallback = false; ///< Requester: the local service had to jump in.
  std::string because{}; ///< A value and its limit, or who wanted it.
};

/// Where a vehicle is, and the plan that it follows.
struct track_record {
  time_point at;
  ego_state ego;
  double lateral_m = 0; ///< Offset of the rear axle from the lane's centre.
  duration plan_age{};
  bool remote = false;
  std::shared_ptr<const world::trajectory> plan{}; ///< May be null.
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
  world::plan_figures plans;
  world::ride_figures ride;
};

/// A vehicle's trip has ended: it has arrived, or the run is over.
struct trip_record {
  station_id station = 0;
  world::trip_figures trip;
};

/// A vehicle's claim of a way through a crossing is over.
struct claim_record {
  station_id station = 0;
  std::string lane{}; ///< By which it came.
  time_point claimed; ///< When it did.
  std::optional<time_point>
      bound;                 ///< When nobody else could claim it any more.
  time_point enters, leaves; ///< The crossing, as claimed.
  bool was_kept = false;     ///< Else it was given up before.
};

/// How late a vehicle responds to its scene, and how late it may.
struct scene_record {
  time_point at;
  station_id station = 0;
  service_name service; ///< That has looked.
  duration safe{};      ///< The longest response time that is safe.
  std::string because;  ///< Who or what asks for no longer one.
  /// Age of the input that the result in use was made from; nullopt: there is
  /// no result yet.
  std::optional<duration> response{};
};

/// What a vehicle has seen goes into its chain of services.
struct sensor_look {
  time_point sensed_at; ///< The sensing instant.
  time_point input_at;  ///< When the input of the first service was made.
};

/// A look from which no plan has come for so long counts no more.
inline constexpr duration look_lasts = std::chrono::seconds{5};

/// A result of a service of a chain has come to who uses it.
struct stage_record {
  station_id station = 0;
  service_name service;
  provider_id provider = 0; ///< That computed it; 0: the vehicle.
  time_point got;
  result_timing timing;
  /// Of the last service: when the first control value depends on it.
  std::optional<time_point> control_at{};
  /// Of the last service: all since its result before.
  std::vector<sensor_look> looks{};

  /// @returns when its cycle began.
  time_point begun() const {
    const auto& [input_at, up, queue, computing, down] = timing;
    return got - down.wait - down.travel - computing - queue;
  }
};

/// The first control value that depends on a look of a vehicle's sensors, and
/// where the time went until then; the parts add up.
struct response_record {
  struct part {
    service_name service;
    provider_id provider = 0; ///< 0: the vehicle.
    /// Until its result was in the vehicle. Nullopt: the next service asked it
    /// at the same provider, and the time is part of that one's.
    std::optional<duration> took{};
    duration up{}, down{}; ///< Of `took`; the rest is waiting and computing.
  };
  station_id station = 0;
  time_point sensed_at;
  time_point control_at;
  duration waited{}; ///< For a later look, if this one was skipped or lost.
  std::vector<part> parts; ///< By service, in the order of the chain.
  duration control{};      ///< From the plan to the control value.

  duration response() const { return control_at - sensed_at; }
};

/// The chain of a vehicle is split otherwise from now on: how late it will
/// respond to what it sees, by what it has measured before.
struct prediction_record {
  time_point at;
  station_id station = 0;
  std::vector<service_place> split; ///< By service, in the chain's order.
  duration p50{}, p99{};
};

/// A vehicle has taken its first plan from another source into use.
struct plan_switch_record {
  time_point at;
  session_id session;  ///< Its remote side, the new or the former one.
  bool remote = false; ///< Where the new plan comes from.
  world::plan_jump jump;
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

/// All that can happen, the only list of it. Records stay in their process: a
/// new one is added here, made where it happens, and used by whom it concerns.
using record =
    std::variant<event_record, decision_record, verdict_record, cycle_record,
                 work_record, episode_record, track_record, safety_record,
                 collision_record, drive_record, trip_record, claim_record,
                 scene_record, stage_record, response_record, prediction_record,
                 plan_switch_record, air_record, trace_record>;

/// Gets the records of a run; implemented by whoever keeps them.
class record_sink {
public:
  virtual ~record_sink() = default;
  virtual void on_record(const record& x) = 0;
};

} // namespace sofof::messages
