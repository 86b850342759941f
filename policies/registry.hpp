// Policies, filters and governors by name; their tables are made from the files
// in policies/lodm, codm, filters and governors (policies/entry.hpp).
#pragma once

#include "policies/api/filter.hpp"
#include "policies/api/governor.hpp"
#include "policies/api/notes.hpp"
#include "policies/api/policy.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// @returns what is said of each, by name.
std::vector<policy_info> lodm_notes();
std::vector<policy_info> codm_notes();
std::vector<policy_info> local_filter_notes();
std::vector<policy_info> central_filter_notes();
std::vector<policy_info> governor_notes();

/// @returns the one of this name with its default options; null for an unknown
/// name.
std::unique_ptr<local_policy> make_lodm(std::string_view name);
std::unique_ptr<central_policy> make_codm(std::string_view name);
std::unique_ptr<local_filter> make_local_filter(std::string_view name);
std::unique_ptr<central_filter> make_central_filter(std::string_view name);
std::unique_ptr<governor> make_governor(std::string_view name);

/// @returns all names, sorted, for error messages and lists.
std::vector<std::string_view> lodm_names();
std::vector<std::string_view> codm_names();
std::vector<std::string_view> local_filter_names();
std::vector<std::string_view> central_filter_names();
std::vector<std::string_view> governor_names();

} // namespace sofof::policies
