// Policies by name; their table is made from the files in policies/lodm and
// policies/codm.
#pragma once

#include "policies/api/notes.hpp"
#include "policies/entry.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace sofof {

/// @returns what is said of each, by name.
std::vector<policy_info> lodm_notes();
std::vector<policy_info> codm_notes();

/// @returns the policy with its default options; null for an unknown name.
std::unique_ptr<local_policy> make_lodm(std::string_view name);
std::unique_ptr<central_policy> make_codm(std::string_view name);

/// @returns all names, for error messages and lists.
std::vector<std::string_view> lodm_names();
std::vector<std::string_view> codm_names();

} // namespace sofof
