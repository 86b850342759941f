// A policy as the registry knows it: a file policies/lodm/NAME.cpp defines
// lodm_NAME(), a file policies/codm/NAME.cpp defines codm_NAME().
#pragma once

#include "policies/api/notes.hpp"
#include "policies/filters/composition.hpp"

#include <memory>

namespace sofof {

template <class Policy>
struct policy_entry {
  policy_info notes;
  std::unique_ptr<Policy> (*make)(); ///< With its default options.
};
using lodm_entry = policy_entry<local_policy>;
using codm_entry = policy_entry<central_policy>;

/// Makes a policy that sees everything.
template <class Policy, class Whole>
std::unique_ptr<Policy> unfiltered() {
  return std::make_unique<Whole>();
}

/// Makes one that chooses among what a filter lets through.
template <class Choice>
std::unique_ptr<local_policy> filtered_by_provider() {
  return std::make_unique<filtered_lodm>(std::make_unique<Choice>());
}
template <class Choice>
std::unique_ptr<central_policy> filtered_by_request() {
  return std::make_unique<filtered_codm>(std::make_unique<Choice>());
}

} // namespace sofof
