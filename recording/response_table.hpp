// How late vehicles responded to what they saw, by the split of their chain.
#pragma once

#include "base/statistics.hpp"
#include "messages/protocol/record.hpp"
#include "recording/run_info.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sofof::recording {

/// Responses while the services of a chain ran in the same places.
struct split_responses {
  distribution all;    ///< From a look to the first control value by it.
  statistics waited_s; ///< Of that: for a later look, which stood in; ...
  std::vector<statistics> services_s; ///< ... until each service's result; of
                                      ///< one that the next asked, nothing.
  statistics control_s;               ///< ... from the plan on.
  std::uint64_t skipped = 0;          ///< Looks that a later one stood in for.
  statistics predicted_p99_ms;        ///< Whenever a vehicle predicted it.

  void add(const messages::response_record& x);
  void add(const messages::prediction_record& x) {
    predicted_p99_ms.add(1e3 * to_seconds(x.p99));
  }
};

/// By split: where each service of the chain ran, in its order, as
/// "vehicle>mec>mec".
using response_table = std::map<std::string, split_responses>;

/// @returns where the services ran that a response depends on.
std::string split_of(const messages::response_record& x,
                     const provider_names& names);
std::string split_of(const messages::prediction_record& x,
                     const provider_names& names);

} // namespace sofof::recording
