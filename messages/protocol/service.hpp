// Offering, requesting, running and ending a service, as it crosses the air.
#pragma once

#include "base/candidate.hpp"
#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/inspect.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/protocol/service_name.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages {

/// One offloading, from acceptance to its end. Both sides and all data name
/// it, so that duplicates and leftovers of earlier ones are told apart.
struct session_id {
  provider_id provider = 0;
  station_id station = 0;
  service_name service;
  std::uint32_t counter = 0; ///< Rising per provider; 0: the local service.
  friend auto operator<=>(const session_id&, const session_id&) = default;

  /// @returns whether it is one with a provider, and not the vehicle's own.
  bool is_remote() const { return counter != 0; }
};

void visit_fields(auto& v, session_id& x) {
  v("provider", x.provider);
  v("station", x.station);
  v("service", x.service);
  v("counter", x.counter);
}

/// A vehicle's own motion, as its CAMs tell it.
struct cam {
  station_id station = 0;
  time_point at;
  point position; ///< Rear axle, m, east-north.
  double heading_rad = 0;
  double speed_mps = 0;
  double accel_mps2 = 0;
  double curvature_1pm = 0; ///< Of its way, left positive.
  double length_m = 5.1;    ///< Of its body; the test vehicle's, as below.
  double width_m = 1.89;
};

void visit_fields(auto& v, cam& x) {
  v("station", x.station);
  v("at", x.at);
  v("position", x.position);
  v("heading_rad", x.heading_rad);
  v("speed_mps", x.speed_mps);
  v("accel_mps2", x.accel_mps2);
  v("curvature_1pm", x.curvature_1pm);
  v("length_m", x.length_m);
  v("width_m", x.width_m);
}

/// How a provider that rides with a vehicle moves when it makes an offer.
struct provider_motion {
  point velocity_mps; ///< East and north.
  double reach_m = 0; ///< It serves who is nearer than this.

  friend bool operator==(const provider_motion&,
                         const provider_motion&) = default;
};

/// When an offer was made, and how its provider moved then. Both may be
/// missing; they travel as one text, so that a provider that stands says of its
/// motion nothing at all.
struct offer_stamp {
  std::optional<time_point>& created;
  std::optional<provider_motion>& moves;

  std::string packed() const;
  /// @returns whether it was one; else nothing has changed.
  bool unpack(const std::string& text);
};

/// A provider has seen a station in its area and offers its services.
struct service_offer {
  provider_id provider = 0;
  point position; ///< Of the provider, m, east-north.
  std::vector<service_name> services;
  /// What runs there needs this share of its workers, ≥ 0; above 1 it falls
  /// behind.
  double utilisation = 0;
  std::uint32_t workers = 1;
  duration computing{}; ///< Mean time of a result of unit demand, > 0 if any.
  /// When it was made: tells how good the way is; none if clocks disagree.
  std::optional<time_point> created{};
  /// Of a provider that rides with a vehicle; such a one makes offers of no
  /// service, too: they tell where it is.
  std::optional<provider_motion> moves{};
};

void visit_fields(auto& v, service_offer& x) {
  v("provider", x.provider);
  v("position", x.position);
  v("services", x.services);
  v("utilisation", x.utilisation);
  v("workers", x.workers);
  v("computing", x.computing);
  offer_stamp stamp{x.created, x.moves};
  v("created", stamp);
}

/// What a provider believes to run for a station, told every
/// protocol::digest_period while something does, and a little longer.
struct session_digest {
  provider_id provider = 0;
  station_id station = 0;
  /// Of the latest session that the provider had accepted by then, whoever's:
  /// of later ones the digest says nothing, however late it comes.
  std::uint32_t last_counter = 0;
  std::vector<session_id> running{};
};

void visit_fields(auto& v, session_digest& x) {
  v("provider", x.provider);
  v("station", x.station);
  v("last_counter", x.last_counter);
  v("running", x.running);
}

/// A requester asks for some of the offered services.
struct service_request {
  provider_id provider = 0;
  station_id station = 0;
  std::uint32_t number = 0; ///< Rising per requester.
  std::vector<service_name> services;
  std::vector<point> route; ///< Planned waypoints from the vehicle on, m.
  double speed_mps = 0;
  /// Whom it could ask, and what it would win; for the first of the services.
  std::vector<candidate> candidates{};
};

void visit_fields(auto& v, service_request& x) {
  v("provider", x.provider);
  v("station", x.station);
  v("number", x.number);
  v("services", x.services);
  v("route", x.route);
  v("speed_mps", x.speed_mps);
  v("candidates", x.candidates);
}

/// What a provider says to one requested service.
struct verdict {
  session_id session; ///< Counter 0 when refused.
  bool accepted = false;
  std::string why;                      ///< Short; for records.
  std::optional<provider_id> instead{}; ///< If refused: another one to ask.
};

void visit_fields(auto& v, verdict& x) {
  v("session", x.session);
  v("accepted", x.accepted);
  v("why", x.why);
  v("instead", x.instead);
}

/// A provider's answer to one request: a verdict for each requested service.
struct service_response {
  provider_id provider = 0;
  station_id station = 0;
  std::uint32_t number = 0; ///< Of the request.
  std::vector<verdict> verdicts;
};

void visit_fields(auto& v, service_response& x) {
  v("provider", x.provider);
  v("station", x.station);
  v("number", x.number);
  v("verdicts", x.verdicts);
}

/// The provider that is fed only when a cycle has not been answered for so
/// long. Source: Dean & Barroso 2013 (hedged requests).
struct standby {
  provider_id provider;
  duration after{}; ///< > 0.

  friend bool operator==(const standby&, const standby&) = default;
};

void visit_fields(auto& v, standby& x) {
  v("provider", x.provider);
  v("after", x.after);
}

/// How long a message was on its way.
struct transit {
  duration wait{};   ///< For its turn in the cell, or for an outage to end.
  duration travel{}; ///< On the air and through the network.

  friend bool operator==(const transit&, const transit&) = default;
};

void visit_fields(auto& v, transit& x) {
  v("wait", x.wait);
  v("travel", x.travel);
}

/// What a session works on next; newer input replaces older. A standby
/// gives one result at once, and the next one at the next such input.
struct service_input {
  session_id session;
  time_point at; ///< When it was made.
  payload what;
  /// The result in use, for a source that takes over from another one, which
  /// shall go on from there; else empty.
  payload in_use{};
  bool standby = false; ///< Else a result comes in every period.
  /// Its way to the provider. Does not travel: whoever carries it fills it in.
  transit up{};
  /// A cycle begins with it besides those of the grid. Does not travel: it is
  /// for the vehicle's own function.
  bool at_once = false;
  /// In a chain, when a sensor saw what it is made of; nullopt: at `at`. Does
  /// not travel.
  std::optional<time_point> sensed{};
};

void visit_fields(auto& v, service_input& x) {
  v("session", x.session);
  v("at", x.at);
  v("what", x.what);
  v("in_use", x.in_use);
  v("standby", x.standby);
}

/// Where the time went between an input and the arrival of its result; the rest
/// is what the input waited for the cycle. No part of it is negative.
struct result_timing {
  time_point input_at{}; ///< When the input was made that this is a result of.
  transit up{};          ///< Of the input.
  duration queue{};      ///< Of the cycle, for a worker.
  duration computing{};
  /// Does not travel: whoever carries the result fills it in.
  transit down{};
};

void visit_fields(auto& v, result_timing& x) {
  v("input_at", x.input_at);
  v("up", x.up);
  v("queue", x.queue);
  v("computing", x.computing);
}

/// What one cycle of a session gave.
struct service_result {
  session_id session;
  std::uint64_t cycle = 0;
  /// Start of the cycle (t_creation); of its input, where there is one result
  /// for each.
  time_point created;
  payload what;
  payload about{}; ///< How it came about, for records; often empty.
  /// `created` may be off by this: clocks of two hosts never quite agree.
  duration doubt{};
  result_timing timing{};
};

void visit_fields(auto& v, service_result& x) {
  v("session", x.session);
  v("cycle", x.cycle);
  v("created", x.created);
  v("what", x.what);
  v("about", x.about);
  v("doubt", x.doubt);
  v("timing", x.timing);
}

/// Why an offloading ended.
enum class end_reason : std::uint8_t {
  left_area,
  cam_timeout,
  qos_latency,
  qos_input_age,
  qos_gap,
  no_data,
  refused,
  peer_lost,
  handed_over, ///< The service goes on at another provider.
  released,    ///< The vehicle took it back, for no fault.
  revoked,     ///< The provider wants its room for others.
  implausible, ///< The vehicle did not believe a result.
  shutdown,
};

constexpr end_reason last_of(end_reason) {
  return end_reason::shutdown;
}

inline constexpr std::string_view name_of(end_reason reason) {
  constexpr std::string_view names[] = {
      "left_area", "cam_timeout", "qos_latency", "qos_input_age", "qos_gap",
      "no_data",   "refused",     "peer_lost",   "handed_over",   "released",
      "revoked",   "implausible", "shutdown"};
  return names[static_cast<std::size_t>(reason)];
}

/// @returns whether an offloading that ends for it has ended as it should; else
/// early, as somebody or something failed it or took its room.
constexpr bool is_planned(end_reason reason) {
  return reason == end_reason::left_area || reason == end_reason::handed_over
         || reason == end_reason::released || reason == end_reason::shutdown;
}

enum class side : std::uint8_t { requester, provider };

constexpr side last_of(side) {
  return side::provider;
}

/// One side has ended a session; saying it twice does no harm.
struct service_end {
  session_id session;
  end_reason reason = end_reason::shutdown;
  side from = side::requester;
  payload what{}; ///< The same in the service's own terms, if it has any.
};

void visit_fields(auto& v, service_end& x) {
  v("session", x.session);
  v("reason", x.reason);
  v("from", x.from);
  v("what", x.what);
}

} // namespace sofof::messages
