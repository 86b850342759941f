// Who runs a service beside another provider without being asked each cycle.
#pragma once

#include "messages/protocol/service.hpp"

#include <optional>

namespace sofof::offloading {

/// @returns whether a provider that runs the service stands by. Without another
/// one that runs it too, it is an ordinary source.
inline bool stands_by(const std::optional<messages::standby>& chosen,
                      provider_id provider, bool another_runs) {
  return chosen && chosen->provider == provider && another_runs;
}

} // namespace sofof::offloading
