// Who runs a service beside another provider without being asked each cycle.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <optional>

namespace sofof::offloading {

/// The provider that is fed only when a cycle has not been answered for so
/// long. Source: Dean & Barroso 2013 (hedged requests).
struct standby {
  provider_id provider = 0;
  duration after{}; ///< > 0.

  friend bool operator==(const standby&, const standby&) = default;
};

/// @returns whether a provider that runs the service stands by. Without another
/// one that runs it too, it is an ordinary source.
inline bool stands_by(const std::optional<standby>& chosen,
                      provider_id provider, bool another_runs) {
  return chosen && chosen->provider == provider && another_runs;
}

} // namespace sofof::offloading
