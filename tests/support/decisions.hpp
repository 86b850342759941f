// What a decision says, in one word, to check it.
#pragma once

#include "policies/api/decision.hpp"

namespace sofof::test {

inline constexpr service_place on_board = std::nullopt;

/// @returns the provider where the service shall run; nullopt where it stays,
/// and when it comes home.
constexpr service_place goes_to(const policies::local_decision& decision) {
  const auto* there = std::get_if<policies::run_at>(&decision.what);
  return there ? service_place{there->provider} : std::nullopt;
}

/// @returns the second provider that shall run it.
constexpr service_place backed_by(const policies::local_decision& decision) {
  const auto second = policies::second_of(decision);
  return second ? service_place{second->provider} : std::nullopt;
}

constexpr bool comes_home(const policies::local_decision& decision) {
  return std::holds_alternative<policies::come_home>(decision.what);
}

/// @param now  Where the service runs.
/// @returns where it runs when the decision has been carried out.
constexpr service_place after(const policies::local_decision& decision,
                              service_place now) {
  if (comes_home(decision))
    return std::nullopt;
  const auto there = goes_to(decision);
  return there ? there : now;
}

/// @returns whether a request is accepted, or a session goes on.
constexpr bool is_accepted(const policies::central_decision& decision) {
  return policies::terms_of(decision);
}

/// @returns the provider that a refused vehicle should ask.
constexpr service_place instead_of(const policies::central_decision& decision) {
  const auto* no = std::get_if<policies::refused>(&decision.what);
  return no ? no->instead : std::nullopt;
}

} // namespace sofof::test
