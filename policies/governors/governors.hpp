// Governors by name.
#pragma once

#include "policies/api/notes.hpp"
#include "policies/governors/governor.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace sofof {

/// @returns what is said of each.
std::vector<policy_info> governor_notes();

/// @returns the governor with its default options; null for an unknown name.
std::unique_ptr<governor> make_governor(std::string_view name);

/// @returns all names, for error messages and lists.
std::vector<std::string_view> governor_names();

} // namespace sofof
