// From which look of a vehicle's sensors a control value has come, through all
// services of a chain.
#pragma once

#include "messages/protocol/record.hpp"

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sofof::recording {

/// Follows results of a chain back to the look that they depend on:
/// * an input of a service was made when the result before it was got;
/// * a provider that computes services one after the other has what the earlier
///   one was given as soon as that one's cycle has begun.
class response_ledger {
public:
  /// @param chain  The services in their order, planning the last: it alone, if
  ///               it does all; none, and nothing is followed.
  explicit response_ledger(const std::vector<std::string>& chain);

  /// @param out  Gets what is known by now.
  void add(const messages::stage_record& x,
           std::vector<messages::response_record>& out);
  /// No more records come.
  void finish(std::vector<messages::response_record>& out);

private:
  struct car {
    std::deque<messages::sensor_look> looks;
    std::vector<std::deque<messages::stage_record>> results; // by service
    std::optional<time_point> answered; // the newest look that was
  };
  /// One of those results by which a plan depends on a look.
  struct step {
    std::size_t service = 0;
    const messages::stage_record* result = nullptr;
    bool asks_there = false; ///< It got the one before at its provider.
  };
  struct way {
    const messages::sensor_look* look = nullptr;
    std::vector<step> steps; ///< From the plan back.
  };

  void follow_until(time_point t, station_id station, car& x,
                    std::vector<messages::response_record>& out) const;
  static way back_from(const car& x, const messages::stage_record& plan);
  void answer(station_id station, car& x, const way& found,
              std::vector<messages::response_record>& out) const;

  std::vector<messages::service_name> chain_;
  std::map<station_id, car> cars_;
};

} // namespace sofof::recording
