// Policies by name: the one place that knows them all.
#pragma once

#include "policies/context.hpp"

#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace sofof {

/// What users are told of a policy, besides its options.
struct policy_notes {
  std::string_view name;
  std::string_view summary; ///< What it does, in a line.
  std::string_view rule;    ///< What it decides by.
  std::string_view sees;    ///< What it needs to know.
  std::string_view source;
};

/// @returns all there are, in the order in which users are told of them.
std::span<const policy_notes> lodm_notes();
std::span<const policy_notes> codm_notes();

/// @returns the policy with its default options; null for an unknown name.
std::unique_ptr<local_policy> make_lodm(std::string_view name);
std::unique_ptr<central_policy> make_codm(std::string_view name);

/// @returns all names, for error messages and lists.
std::vector<std::string_view> lodm_names();
std::vector<std::string_view> codm_names();

} // namespace sofof
