// Functions whose computing times have been measured once.
#pragma once

#include "base/time.hpp"
#include "offloading/service_function.hpp"

#include <cstdint>
#include <optional>

namespace sofof::actors {

/// A `service_function` may be one, too.
class measured_times {
public:
  virtual ~measured_times() = default;

  /// @returns what a cycle takes on board, at the usual clock, > 0; nullopt: as
  /// the service's options say.
  virtual std::optional<duration> measured(std::uint64_t cycle) const = 0;
};

/// @returns what was measured of a function; nullopt: nothing.
inline std::optional<duration>
measured_time(const offloading::service_function& of, std::uint64_t cycle) {
  const auto* known = dynamic_cast<const measured_times*>(&of);
  return known ? known->measured(cycle) : std::nullopt;
}

} // namespace sofof::actors
