// When a vehicle's own function of a service runs along, though results of a
// provider are used.
#pragma once

#include "messages/protocol/qos.hpp"

#include <optional>

namespace sofof::offloading {

/// The own function runs along for a stated time after a provider has taken
/// over, and for the same time after each sign that the service may come home:
/// * it is told so by who decides (`foresee`);
/// * a result that is used has taken more than three quarters of a limit;
/// * for more than three quarters of the longest gap no result has been used.
class warm_standby {
public:
  /// @param time  0: it never runs along.
  warm_standby(duration time, messages::qos_limits limits)
      : time_{time}, limits_{limits} {}

  bool is_on() const { return time_ > duration{0}; }

  /// A provider has taken over.
  void begin(time_point now);

  /// The service may come home.
  void foresee(time_point now);

  /// A result of a provider is used, which was created, and its input made,
  /// then.
  void on_used(time_point created, time_point input_at, time_point now);

  /// The service has come home.
  void end() { until_.reset(); }

  bool runs_along(time_point now) const { return until_ && now < *until_; }

  /// @returns from when on the next result is missing for so long that this is
  /// a sign.
  time_point missed_at() const;

private:
  duration time_;
  messages::qos_limits limits_;
  std::optional<time_point> until_;
  time_point last_; // used result
};

} // namespace sofof::offloading
