// What is going on in a run, for those who look on.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"
#include "messages/protocol/record.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::live {

/// Who plans for a car.
enum class planned : std::uint8_t {
  on_board,
  by_provider,
  not_known, ///< A provider only knows whom it plans for itself.
};

struct seen_car {
  time_point at;   ///< When it was there.
  time_point told; ///< When that became known.
  point position;  ///< Rear axle, m, east-north.
  double heading_rad = 0;
  double speed_mps = 0;
  planned plans = planned::not_known;
  /// By which provider, its place in the file, counting from 0.
  std::optional<std::uint64_t> place{};
  /// Of the last result that came, and when.
  std::optional<duration> latency{};
  time_point result_at{};
  bool is_ours = false; ///< It is driven here, not heard of.
};

struct told_event {
  std::uint64_t number = 0; ///< From 1 on.
  time_point at;
  std::string_view what; ///< Its name.
  station_id station = 0;
  std::optional<std::uint64_t> place{}; ///< Of the provider.
  std::string service, detail;
  std::string_view group; ///< As in a report; "switch" for who plans.
};

struct seen_counts {
  std::uint64_t violations = 0, fallbacks = 0, episodes = 0;
  double driven_s = 0, without_plan_s = 0;
};

/// The newest of all that records and CAMs tell. A mutex is held for as long as
/// it takes to put one thing down, or to copy what there is.
class run_state final : public messages::record_sink {
public:
  /// Cars of which nothing has been heard for so long have gone.
  static constexpr duration silence = std::chrono::seconds{3};
  /// Beyond these no further ones are shown: anybody can make some up.
  static constexpr std::size_t most_cars = 4096;
  /// Older events are forgotten.
  static constexpr std::size_t most_events = 256;

  /// @param planner  The service that plans come from; empty for none.
  /// @param provider  The place of the only provider that runs here, without
  ///                  vehicles; nullopt where vehicles are driven.
  run_state(std::string planner, std::optional<std::uint64_t> provider)
      : planner_{std::move(planner)}, provider_{provider} {}

  void on_record(const messages::record& x) override;
  /// A provider has heard a CAM.
  void on_heard(const messages::cam& x, time_point now);

  /// @returns the cars of which something was heard not long ago, by station.
  std::map<station_id, seen_car> cars(time_point now);
  /// @returns events after one of this number, the oldest first, `most` of the
  /// newest at most.
  std::vector<told_event> events_after(std::uint64_t number,
                                       std::size_t most) const;
  seen_counts counts() const;

private:
  void add(const messages::event_record& x);
  void add(const messages::verdict_record& x);
  void add(const messages::cycle_record& x);
  void add(const messages::episode_record& x);
  void add(const messages::track_record& x);
  void add(const messages::safety_record& x);
  template <class Other>
  void add(const Other&) {}

  seen_car* car_of(station_id station);
  void tell(told_event x);

  const std::string planner_;
  const std::optional<std::uint64_t> provider_;
  mutable std::mutex mutex_;
  std::map<station_id, seen_car> cars_;
  std::map<station_id, std::optional<std::uint64_t>> planned_by_;
  std::deque<told_event> events_;
  std::uint64_t told_ = 0;
  seen_counts counts_;
};

} // namespace sofof::live
