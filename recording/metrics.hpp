// Scores a run while its records come in: sums, and a line for each episode
// that ended early.
#pragma once

#include "base/statistics.hpp"
#include "messages/protocol/record.hpp"
#include "recording/cycle_ledger.hpp"
#include "recording/energy_table.hpp"
#include "recording/load_table.hpp"
#include "recording/response_table.hpp"
#include "recording/run_info.hpp"
#include "recording/split_ledger.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::recording {

inline constexpr std::size_t end_reason_count =
    static_cast<std::size_t>(messages::end_reason::shutdown) + 1;

/// Who comes back to a provider so soon has gone in vain.
inline constexpr duration ping_pong_limit = std::chrono::seconds{5};

/// How often something ended why.
using end_counts = std::array<std::uint64_t, end_reason_count>;

/// How often vehicles refused a result, by the provider's name and the check.
using refusal_counts =
    std::map<std::string, std::map<std::string, std::uint64_t>>;

/// An episode that ended for other than a planned reason.
struct early_end {
  messages::end_reason reason{};
  std::string provider; ///< Its name.
  station_id station = 0;
  time_point at;
  /// When the last result that came was sent; else its acceptance.
  time_point last_sent{};
  /// So long before it the one before that came was sent.
  std::optional<duration> sent_after{};
  /// What took half of the time that was too long, or more: "the computing",
  /// say; empty if nothing did.
  std::string_view mostly{};
  /// What made a gap between results; known a little later, where modelled.
  std::optional<channel::disturbance> disturbed{};
};

/// The figures of one kind of service, as the requesters see it.
struct service_metrics {
  messages::service_name service;
  std::uint64_t offers = 0; ///< That named it.
  // Pairs of a request and a service that it names; the answer counts.
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0; ///< No answer in time is a rejection too.
  std::uint64_t requests() const { return accepted + rejected; }

  std::uint64_t episodes = 0;       ///< Offloadings that got first data.
  std::uint64_t running_at_end = 0; ///< Those of them that the end cut off.
  std::uint64_t no_data = 0;        ///< Offloadings that ended without any.
  std::uint64_t fallbacks = 0;
  std::uint64_t hand_overs = 0; ///< From one provider straight to another.
  /// Times that the source was remote again within `ping_pong_limit`.
  std::uint64_t ping_pongs = 0;
  /// Reasons of all that ended, with data or without.
  end_counts ended_by{};
  /// Of the episodes those that ended early.
  std::vector<early_end> early;
  std::size_t early_told = 0; ///< So many of them, from the first on, have
                              ///< their `disturbed`.
  /// How often a provider refused, and how often the vehicle wanted no
  /// provider, by the reason that was given.
  std::map<std::string, std::uint64_t> refused;
  std::map<std::string, std::uint64_t> stayed;
  refusal_counts implausible; ///< Results that vehicles refused.
  /// Of those that were used, the least by check; empty unless recorded.
  std::map<std::string, double> margins;
  /// Switch to remote → switch back, of each episode that the end of the
  /// drive did not cut off.
  statistics t_off_s;
  /// Of each vehicle, the time that it was not local, at one provider or at
  /// several at once.
  std::map<station_id, double> remote_s;

  // As the providers see it.
  statistics served_s; ///< Acceptance → end, of all that ran there.
  end_counts served_until{};

  std::uint64_t results_used = 0; ///< Of those that `latency` counts.
  distribution latency;           ///< t_receiving − t_creation.
  distribution input_age;         ///< t_receiving − that of the input.
  distribution interarrival;      ///< Between two results of an episode.

  // Given to the modelled cells of all providers; on the air.
  std::uint64_t octets_up = 0;
  std::uint64_t octets_down = 0;

  /// @param driven  By all vehicles together.
  /// @returns the share of that time in which the service was not local;
  /// nullopt for no time.
  std::optional<double> offloaded_share(duration driven) const;

  /// @returns how evenly vehicles are offloaded, by the time x that each is:
  /// (Σx)² / (n Σx²), from 1/n, one alone, to 1; nullopt if none ever is.
  /// Source: Jain, Chiu, Hawe, DEC-TR-301, 1984.
  std::optional<double> fairness(std::size_t vehicles) const;
};

/// How safely vehicles drove.
struct safety_metrics {
  duration driven{};
  duration without_fresh_plan{};
  duration off_road{};
  duration max_plan_age{}; ///< The largest of all.
  std::uint64_t collisions = 0;
  std::uint64_t near_misses = 0; ///< Of all vehicles together only.

  void add(const messages::safety_record& x);

  /// @returns whether the safety line held all the time.
  bool ok() const;
};

/// How one vehicle drove, or all together.
struct drive_metrics {
  safety_metrics safety;
  world::plan_figures plans;
  world::ride_figures ride;
  std::optional<world::trip_figures> trip; ///< Of one vehicle, at its end.
};

/// How vehicles got on, each from its start to its arrival or the end.
class traffic_metrics {
public:
  void add(const world::trip_figures& x);

  std::uint64_t arrived() const { return arrived_; }
  std::uint64_t stops() const { return stops_; }
  /// @returns nullopt where nobody drove.
  std::optional<double> longest_stop_s() const;
  const statistics& delay_s() const { return delay_s_; }
  /// @returns the least delay that a share `p` of all does not exceed.
  std::optional<double> delay_s(double p) const;

private:
  std::uint64_t arrived_ = 0, stops_ = 0;
  double longest_stop_s_ = 0;
  statistics delay_s_;
  std::vector<double> delays_s_;
};

/// How far plans jumped when their source changed, all vehicles together.
struct switch_metrics {
  statistics d_m;
  statistics curvature_1pm;
  statistics speed_mps;
  statistics accel_mps2;

  std::uint64_t count() const { return d_m.count(); }
};

/// What was sent of one kind of ITS message.
struct air_count {
  std::uint64_t messages = 0;
  std::uint64_t octets = 0; ///< Of the messages alone.

  void add(std::size_t size) {
    ++messages;
    octets += size;
  }
  /// @returns how long one is, on average.
  std::optional<double> mean_octets() const {
    if (messages == 0)
      return std::nullopt;
    return static_cast<double>(octets) / static_cast<double>(messages);
  }
};

/// All ITS messages of a run.
struct air_metrics {
  air_count cam, cpm, mcm_up, mcm_down;
};

/// All figures of a run. Meanings: docs/results.md.
class metrics {
public:
  /// @param run  Its services are listed even when nothing happens to them;
  ///             others follow in the order of their first record.
  explicit metrics(const run_info& run);

  void on_record(const messages::record& x);

  /// Messages that were disturbed, in order of time.
  /// @param until  All of those that were sent before then are known now.
  void add(std::span<const disturbed_messages> all, time_point until);

  /// What providers and their cells had to do; once, before the end.
  void add(load_table of_all);

  /// The run ends: what is still offloaded counts up to here.
  void finish(time_point end);

  std::uint64_t offers() const { return offers_; }
  std::span<const service_metrics> services() const { return services_; }
  /// @returns the figures that stand at the top level of the summary.
  const service_metrics& headline() const;
  const safety_metrics& safety() const { return together_.safety; }
  /// @returns the sums and extremes of all vehicles.
  const drive_metrics& together() const { return together_; }
  /// @returns the same of each vehicle, by station.
  const std::map<station_id, drive_metrics>& vehicles() const {
    return vehicles_;
  }
  /// @returns how often services were computed, and what that took.
  const cycle_ledger& work() const { return work_; }
  /// @returns the same of the service whose figures stand at the top level.
  cycle_figures cycles() const { return work_.cycles(headline_); }
  cycle_figures cycles(station_id station) const {
    return work_.cycles(headline_, station);
  }
  /// @returns the energy of both ends; nothing before the end.
  const energy_table& energy() const { return energy_; }
  const traffic_metrics& traffic() const { return traffic_; }
  const switch_metrics& switches() const { return switches_; }
  const air_metrics& air() const { return air_; }
  const load_table& load() const { return load_; }
  const response_table& responses() const { return responses_; }
  /// @returns those of all splits together.
  const distribution& response() const { return response_; }
  /// @returns the vehicles whose headline service is remote just now.
  std::size_t offloaded_now() const;

private:
  struct open_episode {
    messages::session_id session;
    time_point remote_since; ///< Perhaps at other providers before.
  };
  /// Of a session.
  struct last_result {
    messages::session_id session;
    time_point sent;
    messages::result_timing timing;
    duration rest;
    bool counts_from_input; ///< Its latency does, as its service asks for.
    std::optional<duration> sent_after; ///< The one before.
  };

  /// Where a service was remote before.
  struct left_provider {
    provider_id provider = 0;
    time_point at;
  };
  using user = std::pair<messages::service_name, station_id>;

  void add(const messages::event_record& x);
  void add(const messages::decision_record& x);
  void add(const messages::cycle_record& x);
  void add(const messages::work_record& x) { work_.add(x); }
  void add(const messages::episode_record& x);
  void add(const messages::safety_record& x);
  void add(const messages::collision_record& x);
  void add(const messages::drive_record& x);
  void add(const messages::trip_record& x);
  void add(const messages::plan_switch_record& x);
  void add(const messages::air_record& x);
  void add(const messages::response_record& x) {
    responses_[split_of(x, names_)].add(x);
    response_.add(x.response());
  }
  void add(const messages::prediction_record& x) {
    responses_[split_of(x, names_)].add(x);
  }
  template <class Other>
  void add(const Other&) {}

  service_metrics& of(const messages::service_name& name);
  void count_offer(std::string_view services);
  void source_changed(const messages::event_record& x);

  time_point start_;
  messages::service_name headline_;
  provider_names names_;
  cycle_ledger work_;
  energy_terms energy_terms_;
  split_ledger splits_;
  energy_table energy_;
  std::uint32_t obstacles_;
  std::uint64_t offers_ = 0;
  std::vector<service_metrics> services_;
  std::map<user, open_episode> open_;
  std::map<user, left_provider> left_; ///< The last one.
  std::map<user, last_result> results_;
  load_table recent_; // of the cells, what was disturbed lately
  drive_metrics together_;
  std::map<station_id, drive_metrics> vehicles_;
  traffic_metrics traffic_;
  switch_metrics switches_;
  air_metrics air_;
  load_table load_;
  response_table responses_;
  distribution response_;
};

} // namespace sofof::recording
