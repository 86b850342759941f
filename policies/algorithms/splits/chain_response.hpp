// How late a vehicle will respond to what it sees if its chain of services is
// split otherwise.
#pragma once

#include "base/ids.hpp"
#include "policies/algorithms/splits/time_law.hpp"

#include <map>
#include <span>
#include <vector>

namespace sofof::policies {

/// What results of a service took at a provider.
struct times_there {
  time_law up, computing, down; ///< Waits for the cell, for a worker included.
};

/// What results of a service of a chain take.
struct service_times {
  /// A result comes in every period, from the newest input; else (zero) one for
  /// each input, at once.
  duration period{};
  duration input_period{}; ///< At least this between two inputs on the air.
  time_law on_board;       ///< Its computing in the vehicle.
  std::map<provider_id, times_there> at;
};

/// Where each service of a chain runs, in its order.
using chain_split = std::vector<service_place>;

/// From a look to the first control value that depends on it:
/// * looks come every protocol::sensor_period; of what is more often than the
///   input period of the service that it goes up for, the next one that goes up
///   stands in;
/// * each service waits for the one before it; one with a period also for its
///   next cycle, which is up to a period later, any time as likely;
/// * what runs at a provider takes the way up, the computing and the way down;
/// * a service with a period that runs where those before it run asks them
///   there, as soon as they have got their input;
/// * the control value is that of the next control step; looks come with one.
/// @param split  As long as the chain.
/// @returns its law if all of these are independent; unknown if one of them is.
time_law predicted_response(std::span<const service_times> chain,
                            const chain_split& split);

} // namespace sofof::policies
