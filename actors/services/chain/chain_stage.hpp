// What stands between two services of a chain in a vehicle.
#pragma once

#include "actors/simulation/service_client.hpp"
#include "messages/protocol/payload.hpp"
#include "messages/protocol/service.hpp"

#include <functional>

namespace sofof::actors {

/// Makes of a service's newest input and its result the input of the next one.
using onward = std::function<messages::payload(
    const messages::payload& input, const messages::service_result& result)>;

/// The client of a service of a chain. It asks that service with each input of
/// the stage before, and the next one with each of its results, and tells the
/// vehicle its place in the chain.
/// @param is_warm  Its own function runs along before it comes home: the first
///                 result then begins a cycle of the functions after it at
///                 once.
messages::client_actor spawn_chain_stage(const client_place& where, onward make,
                                         bool is_warm);

} // namespace sofof::actors
