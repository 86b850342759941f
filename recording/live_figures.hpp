// What an operator watches while a process runs.
#pragma once

#include "messages/protocol/record.hpp"
#include "recording/exposition.hpp"
#include "recording/metrics.hpp"
#include "recording/run_info.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::recording {

/// How often something was how long; one thread adds, any reads.
class live_histogram {
public:
  /// The limits of services (50 and 100 ms) are among them, s.
  static constexpr std::array limits{.005, .01, .02, .03, .05,
                                     .075, .1,  .25, 1.};

  void add(duration x);
  void write(exposition& to, const exposition::labels& of) const;

private:
  std::array<std::atomic<std::uint64_t>, limits.size() + 1> counts_{};
  std::atomic<double> sum_s_ = 0;
};

/// Counters by names that come up as a run goes on; one thread adds, any
/// reads. Names beyond the first few are counted together, as "other".
class live_counters {
public:
  void add(std::string_view name);
  /// Tells of it, too, before there is any.
  void expect(std::string_view name);

  /// Calls `tell(name, count)` for each.
  template <class Tell>
  void each(const Tell& tell) const {
    const auto size = size_.load(std::memory_order_acquire);
    for (std::size_t i = 0; i < size; ++i)
      tell(std::string_view{all_[i].name}, all_[i].count.load());
  }

private:
  static constexpr std::size_t most = 24;
  struct named {
    std::string name; ///< Written before `size_` covers it.
    std::atomic<std::uint64_t> count = 0;
  };
  named& at(std::string_view name);

  std::array<named, most> all_{};
  std::atomic<std::size_t> size_ = 0;
};

/// Counts what the records of a process tell, without a lock. Names:
/// docs/operations/README.md.
class live_figures final : public messages::record_sink {
public:
  /// What else is told, each time that somebody asks.
  using more = std::function<void(exposition&)>;

  /// @param role   Of the process: "provide", "drive", "run".
  /// @param also   Called on the threads of those who ask; may be empty.
  live_figures(const run_info& run, std::string role, more also);

  void on_record(const messages::record& x) override;

  /// @returns all of it, as of now.
  std::string text(exposition_format format) const;

private:
  using count = std::atomic<std::uint64_t>;
  /// Of one service.
  struct service_figures {
    explicit service_figures(std::string service) : name{std::move(service)} {}
    std::string name;
    std::atomic<std::int64_t> running = 0;
    count used = 0, late = 0, unknown = 0, other = 0; ///< Results.
    count fallbacks = 0;
    live_counters verdicts, ended, violations, implausible;
    count accepted = 0, rejected = 0;
    live_histogram latency, gap, input_age, wait;
  };
  using user = std::pair<std::string_view, station_id>;

  void add(const messages::event_record& x);
  void add(const messages::decision_record& x);
  void add(const messages::verdict_record& x);
  void add(const messages::cycle_record& x);
  void add(const messages::episode_record& x);
  void add(const messages::safety_record& x);
  void add(const messages::collision_record&) { ++collisions_; }
  void add(const messages::air_record& x);
  template <class Other>
  void add(const Other&) {}

  service_figures* find(const messages::service_name& name);
  void write_services(exposition& to) const;
  void write_driving(exposition& to) const;
  void write_air(exposition& to) const;

  const std::string version_, role_;
  const bool is_provider_; ///< And no vehicles.
  const more also_;
  std::deque<service_figures> services_; // as many as at first
  std::atomic<std::int64_t> vehicles_ = 0, peers_ = 0, providers_ = 0;
  count refused_peers_ = 0, offers_ = 0, collisions_ = 0, near_misses_ = 0;
  std::atomic<double> driven_s_ = 0, without_plan_s_ = 0, off_road_s_ = 0;
  struct air_figures {
    count messages = 0, octets = 0;
  };
  std::array<air_figures, 4> air_{};
  // Of the thread that adds alone:
  std::set<user> remote_, late_, in_doubt_;
};

} // namespace sofof::recording
