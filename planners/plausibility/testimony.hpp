// Who else has seen a body, and who has looked and has not.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace sofof::planners {

/// Who looks at the road.
struct road_observer {
  std::uint32_t number = 0; ///< The station of a vehicle, or a sensor's.
  bool is_ours = false;     ///< A sensor of the provider.
  sender_id sender = 0;     ///< Of a vehicle.

  friend bool operator==(const road_observer&, const road_observer&) = default;
};

/// What is said of one body that one sender tells of.
class testimony {
public:
  /// Its sender, who does not count as anybody else; none: a sensor of the
  /// provider has seen it first.
  void teller(std::optional<sender_id> who) { tells_ = who; }
  std::optional<sender_id> teller() const { return tells_; }

  /// The observer sees it.
  void confirm(const road_observer& who, time_point at);

  /// The observer would see it, and does not.
  /// @param is_sure  Else a message of it may have been lost: a vehicle's
  ///                 denial counts when it holds until the next one.
  void deny(const road_observer& who, time_point at, bool is_sure);

  /// @returns whether anybody else has seen it within 1.25 s, who has not
  /// denied it since.
  bool is_confirmed(time_point now) const;

  bool was_ever_confirmed() const { return was_confirmed_; }
  bool is_denied() const { return denials_ > 0 || !denied_.empty(); }
  time_point first_denied() const { return first_denied_; }

  /// @returns whether sensors of the provider deny it, three looks in a row,
  /// or vehicles of two senders do that do not tell of it.
  bool is_denied_for_all() const;

  /// @returns whether this vehicle denies it, whoever tells of it.
  bool is_denied_by(station_id who) const;

private:
  struct confirmation {
    road_observer by;
    time_point at;
  };
  std::optional<sender_id> tells_;
  std::vector<confirmation> confirmed_; // the newest of each
  struct denial {
    road_observer by;
    time_point since;
    bool counts;
  };
  std::vector<denial> denied_; // by vehicles, each once
  int denials_ = 0;            // of our sensors, in a row
  time_point first_denied_;
  bool was_confirmed_ = false;
};

} // namespace sofof::planners
