// Who gives a vehicle's program its inputs.
#pragma once

#include "actors/services/programs/input_source.hpp"
#include "actors/simulation/service_client.hpp"
#include "messages/protocol/service_name.hpp"

#include <memory>

namespace sofof::actors {

/// What a client asks for.
struct program_questions {
  messages::service_name service;
  std::shared_ptr<const input_source> from; ///< Not null.
  duration period{};                        ///< > 0, between two inputs.
};

/// Asks the service every period, at moments of its own in each vehicle, and
/// keeps the newest result for others.
/// @param where  Its `view` is not null.
messages::client_actor spawn_program_client(const client_place& where,
                                            program_questions asks);

} // namespace sofof::actors
