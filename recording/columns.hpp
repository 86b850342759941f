// The columns of a run's CSV files, one by one: docs/results.md.
#pragma once

#include "base/text/csv.hpp"
#include "messages/protocol/record.hpp"
#include "recording/metrics.hpp"

#include <string>
#include <string_view>

namespace sofof::recording {

/// What rows of records need besides: who the provider is, and second 0.
struct row_context {
  std::string_view provider; ///< Its name.
  time_point start;
};

struct episode_row {
  const messages::episode_record& x;
  row_context in;

  const messages::session_id& id() const { return x.session; }
  bool by_requester() const { return x.of == messages::side::requester; }
  decimal if_data(duration d) const {
    return by_requester() && x.got_data ? seconds(d) : decimal{};
  }
};

struct cycle_row {
  const messages::cycle_record& x;
  row_context in;

  const messages::session_id& id() const { return x.session; }
};

struct margin_row {
  const messages::cycle_record& x;
  const messages::cycle_record::margin& of;
  row_context in;

  const messages::session_id& id() const { return x.session; }
};

struct claim_row {
  const messages::claim_record& x;
  row_context in;

  decimal at(std::optional<time_point> t) const {
    return t ? seconds(*t - in.start) : decimal{std::nullopt, 9};
  }
};

struct scene_row {
  const messages::scene_record& x;
  time_point start;
};

struct response_row {
  const messages::response_record& x;
  std::string split;
  std::string services_ms; ///< In the chain's order, "-" for no time.
  time_point start;

  response_row(const messages::response_record& x, const provider_names& names,
               time_point start);
};

struct trace_row {
  const messages::trace_record& x;
  time_point start;
  std::string services; ///< "one#7 two#0"

  trace_row(const messages::trace_record& x, time_point start);
};

struct disturbed_row {
  const disturbed_messages& of;
};

/// Of a plan, where the car shall be then.
struct plan_row {
  const messages::track_record& x;
  row_context in;
  world::trajectory_point of;
  duration ahead;
};

struct track_row {
  const messages::track_record& x;
  row_context in;

  const messages::cam& own() const { return x.ego.own; }
};

/// How a vehicle drove.
struct vehicle_row {
  station_id station = 0;
  const drive_metrics& x;
  cycle_figures cycles;  ///< Of the headline service.
  energy_figures energy; ///< Of all.
};

struct distribution_row {
  messages::service_name service;
  std::string_view figure;
  distribution::bin bin;
};

namespace columns {

inline constexpr int length_places = 3;
inline constexpr int angle_places = 6;
inline constexpr int comfort_places = 6;
inline constexpr int margin_places = 4;
inline constexpr int energy_places = 6;
inline constexpr int delay_places = 3;

// Which offloading it was.
inline constexpr auto station = [](const auto& r) {
  return r.id().station.value();
};
inline constexpr auto provider = [](const auto& r) { return r.in.provider; };
inline constexpr auto provider_id = [](const auto& r) {
  return r.id().provider.value();
};
inline constexpr auto service = [](const auto& r) {
  return r.id().service.view();
};
inline constexpr auto counter = [](const auto& r) { return r.id().counter; };
inline constexpr auto cycle = [](const auto& r) { return r.x.cycle; };
inline constexpr auto received = [](const auto& r) {
  return seconds(r.x.received - r.in.start);
};

inline constexpr csv_column<episode_row> of_episodes[]{
    {"side",
     [](const auto& r) -> std::string_view {
       return r.by_requester() ? "requester" : "provider";
     }},
    {"station", station},
    {"provider", provider},
    {"provider_id", provider_id},
    {"service", service},
    {"counter", counter},
    {"accepted_s",
     [](const auto& r) { return seconds(r.x.accepted - r.in.start); }},
    {"first_data_s",
     [](const auto& r) { return r.if_data(r.x.first_data - r.in.start); }},
    {"ended_s", [](const auto& r) { return seconds(r.x.ended - r.in.start); }},
    {"t_off_s",
     [](const auto& r) { return r.if_data(r.x.ended - r.x.first_data); }},
    {"reason", [](const auto& r) { return name_of(r.x.reason); }},
    {"fallback", [](const auto& r) { return r.x.fallback; }},
    {"because", [](const auto& r) { return std::string_view{r.x.because}; }},
};

inline constexpr csv_column<cycle_row> of_cycles[]{
    {"station", station},
    {"provider", provider},
    {"provider_id", provider_id},
    {"service", service},
    {"counter", counter},
    {"cycle", cycle},
    {"created_s",
     [](const auto& r) { return seconds(r.x.created - r.in.start); }},
    {"received_s", received},
    {"latency_ms",
     [](const auto& r) { return milliseconds(r.x.received - r.x.created); }},
    {"input_age_ms",
     [](const auto& r) {
       return milliseconds(r.x.received - r.x.timing.input_at);
     }},
    {"interarrival_ms",
     [](const auto& r) { return milliseconds(r.x.interarrival); }},
    {"used", [](const auto& r) { return r.x.used; }},
    {"doubt_ms",
     [](const auto& r) {
       return r.x.doubt > duration{} ? milliseconds(r.x.doubt) : decimal{};
     }},
    {"uplink_wait_ms",
     [](const auto& r) { return milliseconds(r.x.timing.up.wait); }},
    {"uplink_ms",
     [](const auto& r) { return milliseconds(r.x.timing.up.travel); }},
    {"queue_ms", [](const auto& r) { return milliseconds(r.x.timing.queue); }},
    {"computing_ms",
     [](const auto& r) { return milliseconds(r.x.timing.computing); }},
    {"downlink_wait_ms",
     [](const auto& r) { return milliseconds(r.x.timing.down.wait); }},
    {"downlink_ms",
     [](const auto& r) { return milliseconds(r.x.timing.down.travel); }},
    {"rest_ms", [](const auto& r) { return milliseconds(r.x.rest()); }},
};

inline constexpr csv_column<margin_row> of_margins[]{
    {"station", station},
    {"provider", provider},
    {"provider_id", provider_id},
    {"service", service},
    {"counter", counter},
    {"cycle", cycle},
    {"received_s", received},
    {"margin", [](const auto& r) { return std::string_view{r.of.name}; }},
    {"left", [](const auto& r) { return rounded(r.of.left, margin_places); }},
};

inline constexpr csv_column<claim_row> of_claims[]{
    {"station", [](const auto& r) { return r.x.station.value(); }},
    {"lane", [](const auto& r) { return std::string_view{r.x.lane}; }},
    {"claimed_s", [](const auto& r) { return r.at(r.x.claimed); }},
    {"bound_s", [](const auto& r) { return r.at(r.x.bound); }},
    {"enters_s", [](const auto& r) { return r.at(r.x.enters); }},
    {"leaves_s", [](const auto& r) { return r.at(r.x.leaves); }},
    {"kept", [](const auto& r) { return r.x.was_kept; }},
};

inline constexpr csv_column<scene_row> of_scenes[]{
    {"t_s", [](const auto& r) { return seconds(r.x.at - r.start); }},
    {"station", [](const auto& r) { return r.x.station.value(); }},
    {"service", [](const auto& r) { return r.x.service.view(); }},
    {"safe_ms", [](const auto& r) { return milliseconds(r.x.safe); }},
    {"because", [](const auto& r) { return std::string_view{r.x.because}; }},
    {"response_ms", [](const auto& r) { return milliseconds(r.x.response); }},
};

inline constexpr csv_column<response_row> of_responses[]{
    {"t_s", [](const auto& r) { return seconds(r.x.sensed_at - r.start); }},
    {"station", [](const auto& r) { return r.x.station.value(); }},
    {"split", [](const auto& r) { return std::string_view{r.split}; }},
    {"response_ms", [](const auto& r) { return milliseconds(r.x.response()); }},
    {"waited_ms", [](const auto& r) { return milliseconds(r.x.waited); }},
    {"services_ms",
     [](const auto& r) { return std::string_view{r.services_ms}; }},
    {"control_ms", [](const auto& r) { return milliseconds(r.x.control); }},
};

inline constexpr csv_column<trace_row> of_trace[]{
    {"t_s", [](const auto& r) { return seconds(r.x.at - r.start); }},
    {"by", [](const auto& r) { return name_of(r.x.by); }},
    {"step", [](const auto& r) { return r.x.step; }},
    {"what", [](const auto& r) { return name_of(r.x.what); }},
    {"provider_id", [](const auto& r) { return r.x.provider.value(); }},
    {"station", [](const auto& r) { return r.x.station.value(); }},
    {"number", [](const auto& r) { return r.x.number; }},
    {"services", [](const auto& r) { return std::string_view{r.services}; }},
    {"detail", [](const auto& r) { return std::string_view{r.x.detail}; }},
};

inline constexpr csv_column<disturbed_row> of_disturbed[]{
    {"t_s", [](const auto& r) { return seconds(r.of.x.at); }},
    {"provider", [](const auto& r) { return std::string_view{r.of.provider}; }},
    {"direction", [](const auto& r) { return r.of.direction; }},
    {"station",
     [](const auto& r) { return std::uint64_t{r.of.x.station.value()}; }},
    {"what", [](const auto& r) { return std::string_view{r.of.x.what}; }},
    {"lost", [](const auto& r) { return r.of.x.count.lost; }},
    {"outage", [](const auto& r) { return r.of.x.count.outage; }},
    {"stall", [](const auto& r) { return r.of.x.count.stall; }},
    {"slow", [](const auto& r) { return r.of.x.count.slow; }},
    {"copied", [](const auto& r) { return r.of.x.count.copied; }},
    {"overtaken", [](const auto& r) { return r.of.x.count.overtaken; }},
};

inline constexpr csv_column<track_row> of_tracks[]{
    {"t_s", [](const auto& r) { return seconds(r.x.at - r.in.start); }},
    {"station", [](const auto& r) { return r.own().station.value(); }},
    {"x_m",
     [](const auto& r) {
       return rounded(r.own().position.x_m, length_places);
     }},
    {"y_m",
     [](const auto& r) {
       return rounded(r.own().position.y_m, length_places);
     }},
    {"heading_rad",
     [](const auto& r) { return rounded(r.own().heading_rad, angle_places); }},
    {"speed_mps",
     [](const auto& r) { return rounded(r.own().speed_mps, length_places); }},
    {"accel_mps2",
     [](const auto& r) { return rounded(r.own().accel_mps2, length_places); }},
    {"s_m", [](const auto& r) { return rounded(r.x.ego.s_m, length_places); }},
    {"lateral_m",
     [](const auto& r) { return rounded(r.x.lateral_m, length_places); }},
    {"plan_age_ms", [](const auto& r) { return milliseconds(r.x.plan_age); }},
    {"source",
     [](const auto& r) -> std::string_view {
       return r.x.remote ? "remote" : "local";
     }},
};

inline constexpr csv_column<plan_row> of_plans[]{
    {"t_s", [](const auto& r) { return seconds(r.x.at - r.in.start); }},
    {"station", [](const auto& r) { return r.x.ego.own.station.value(); }},
    {"ahead_s", [](const auto& r) { return seconds(r.ahead); }},
    {"x_m", [](const auto& r) { return rounded(r.of.at.x_m, length_places); }},
    {"y_m", [](const auto& r) { return rounded(r.of.at.y_m, length_places); }},
    {"speed_mps",
     [](const auto& r) { return rounded(r.of.speed_mps, length_places); }},
};

inline constexpr csv_column<vehicle_row> of_vehicles[]{
    {"station", [](const auto& r) { return r.station.value(); }},
    {"driven_s", [](const auto& r) { return seconds(r.x.safety.driven); }},
    {"distance_m",
     [](const auto& r) { return rounded(r.x.ride.distance_m, length_places); }},
    {"without_fresh_plan_s",
     [](const auto& r) { return seconds(r.x.safety.without_fresh_plan); }},
    {"off_road_s", [](const auto& r) { return seconds(r.x.safety.off_road); }},
    {"collisions", [](const auto& r) { return r.x.safety.collisions; }},
    {"max_plan_age_ms",
     [](const auto& r) { return milliseconds(r.x.safety.max_plan_age); }},
    {"plans", [](const auto& r) { return r.x.plans.count; }},
    {"emergency_plans", [](const auto& r) { return r.x.plans.emergency; }},
    {"kept_plans", [](const auto& r) { return r.x.plans.kept; }},
    {"stop_plans", [](const auto& r) { return r.x.plans.stops; }},
    {"imperfect_plans", [](const auto& r) { return r.x.plans.imperfect; }},
    {"safe_stops", [](const auto& r) { return r.x.plans.safe_stops; }},
    {"min_accel_mps2",
     [](const auto& r) {
       return rounded(r.x.ride.extremes.min_accel_mps2, comfort_places);
     }},
    {"max_jerk_mps3",
     [](const auto& r) {
       return rounded(r.x.ride.extremes.jerk_mps3, comfort_places);
     }},
    {"max_lateral_accel_mps2",
     [](const auto& r) {
       return rounded(r.x.ride.extremes.lateral_accel_mps2, comfort_places);
     }},
    {"hard_brakes", [](const auto& r) { return r.x.ride.hard_brakes; }},
    {"comfort_cost_m2ps3",
     [](const auto& r) {
       return rounded(r.x.ride.comfort_cost_m2ps3, comfort_places);
     }},
    {"delay_s",
     [](const auto& r) {
       return rounded(r.x.trip ? std::optional{r.x.trip->delay_s()}
                               : std::nullopt,
                      delay_places);
     }},
    {"stops", [](const auto& r) { return r.x.trip ? r.x.trip->stops : 0; }},
    {"longest_stop_s",
     [](const auto& r) {
       return rounded(r.x.trip ? r.x.trip->longest_stop_s : 0, delay_places);
     }},
    {"arrived",
     [](const auto& r) { return r.x.trip && r.x.trip->has_arrived; }},
    {"on_board_cycles", [](const auto& r) { return r.cycles.on_board; }},
    {"offloaded_cycles", [](const auto& r) { return r.cycles.offloaded; }},
    {"energy_j",
     [](const auto& r) { return rounded(r.energy.j(), energy_places); }},
    {"all_on_board_j",
     [](const auto& r) {
       return rounded(r.energy.all_on_board_j, energy_places);
     }},
};

inline constexpr csv_column<distribution_row> of_distributions[]{
    {"service", [](const auto& r) { return r.service.view(); }},
    {"figure", [](const auto& r) { return r.figure; }},
    {"up_to_ms",
     [](const auto& r) { return rounded(r.bin.up_to_ms, length_places); }},
    {"count", [](const auto& r) { return r.bin.count; }},
};

} // namespace columns

} // namespace sofof::recording
