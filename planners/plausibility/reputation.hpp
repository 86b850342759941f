// Whose word counts for less, and how long.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <map>
#include <utility>

namespace sofof::planners {

/// Who has told of what was not there is distrusted for a minute, the next
/// time for two, and so on. What one vehicle has found out holds for it alone.
class reputation {
public:
  /// Stands for all vehicles.
  static constexpr station_id everybody = 0;

  /// @param by  Who has found out.
  void blame(sender_id who, station_id by, time_point now);

  bool is_distrusted(sender_id who, station_id by, time_point now) const;

  /// @returns whether anybody is distrusted by anybody.
  bool has_liars(time_point now) const { return now < latest_; }

  /// Forgets who has been trusted again for long.
  void tidy(time_point now);

private:
  struct term {
    time_point until;
    duration length;
  };
  std::map<std::pair<sender_id, station_id>, term> terms_;
  time_point latest_{-longest_time}; // end of a term
};

} // namespace sofof::planners
