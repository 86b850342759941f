// The end of a connection to a provider that the provider can reach, in the
// process of its vehicles.
#pragma once

#include "actors/remote/provider_connection.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>

#include <memory>
#include <string>

namespace sofof::actors {

/// What an endpoint tells the connection that made it, whose handle never
/// leaves the process.
using vehicle_endpoint_owner = messages::vehicle_endpoint_actor::extend<
    // The provider has let us in.
    messages::reacts_to<messages::peer_welcome,
                        messages::provider_endpoint_actor>,
    // It has not, for this reason; whether it will never do so.
    messages::reacts_to<std::string, bool>>;

/// Introduces us at an acceptor. If it lets us in, passes on what its peer
/// sends and is whom that peer hears; if not, tells why and ends. Ends with its
/// owner, too.
messages::vehicle_endpoint_actor
spawn_vehicle_endpoint(caf::actor_system& sys,
                       const messages::acceptor_actor& acceptor,
                       std::shared_ptr<const provider_connection_setup> setup,
                       const vehicle_endpoint_owner& owner);

} // namespace sofof::actors
