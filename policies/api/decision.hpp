// What the deciders say.
#pragma once

#include "base/ids.hpp"
#include "base/reason.hpp"
#include "base/time.hpp"

#include <cstddef>
#include <optional>
#include <variant>

namespace sofof::policies {

/// Another provider that runs a service at the same time: of each cycle the
/// first result is used.
struct second_provider {
  provider_id provider;
  /// It plans only cycles that the first has not answered for so long after
  /// they began (a hedge); with 0 it plans all.
  duration hedge_after{};
};

/// The service stays where it is.
struct stay {
  /// Beside the provider where it runs; while it runs at none, this one alone.
  /// Without, a second one that runs already goes on.
  std::optional<second_provider> second{};
};

/// The service comes home, and no provider is asked.
struct come_home {};

/// The service shall run at a provider. Where it runs already it goes on until
/// it has come to the new one (hand-over).
struct run_at {
  provider_id provider;
  std::optional<second_provider> second{}; ///< Without, any other one ends.
  double advantage = 1; ///< Over where it runs: a normalised gain, if known.
};

/// What an LODM says of one service.
struct local_decision {
  std::variant<stay, come_home, run_at> what;
  reason why; ///< For the records.
};

/// @returns a decision to leave all as it is.
constexpr local_decision as_it_is(reason why) {
  return {stay{}, why};
}

/// @param now     Where the service runs.
/// @param wanted  Where alone it shall run.
constexpr local_decision at_place(service_place now, service_place wanted,
                                  reason why) {
  if (wanted)
    return {run_at{.provider = *wanted}, why};
  return now ? local_decision{come_home{}, why} : as_it_is(why);
}

/// @returns the second provider that a decision asks for.
constexpr std::optional<second_provider>
second_of(const local_decision& decision) {
  if (const auto* there = std::get_if<run_at>(&decision.what))
    return there->second;
  const auto* here = std::get_if<stay>(&decision.what);
  return here ? here->second : std::nullopt;
}

/// @returns the decision with another second provider, or none, unless the
/// service comes home.
constexpr local_decision
with_second(local_decision decision,
            const std::optional<second_provider>& second) {
  if (auto* there = std::get_if<run_at>(&decision.what))
    there->second = second;
  else if (auto* here = std::get_if<stay>(&decision.what))
    here->second = second;
  return decision;
}

/// The service runs at the provider, from now on or as before.
struct accepted {
  std::size_t worker = 0; ///< That the policy counts on.
  /// When in the period its cycles begin; drawn if the policy assigns none.
  std::optional<duration> offset{};
};

/// The service does not run at the provider, or ends there.
struct refused {
  std::optional<provider_id> instead{}; ///< Another one to ask.
};

/// What a CODM says of one request or one session.
struct central_decision {
  std::variant<refused, accepted> what;
  reason why; ///< For the records.
};

/// @returns the terms on which a request is accepted; null if it is not.
constexpr const accepted* terms_of(const central_decision& decision) {
  return std::get_if<accepted>(&decision.what);
}

} // namespace sofof::policies
