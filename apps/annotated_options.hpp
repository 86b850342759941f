// Options as a scenario has them, with what they mean beside.
#pragma once

#include "base/options/option_visitor.hpp"
#include "policies/api/notes.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::apps {

/// Prints options with their defaults as TOML under a header: each with a
/// comment that tells its unit, its range and its meaning; of its tables, such
/// as a filter, the names alone.
/// @param header  E.g. "[policies.lodm]".
/// @param list    Lists the options: `name`, and those of the notes.
std::string print_documented(std::string_view header,
                             const std::function<void(option_visitor&)>& list,
                             const std::vector<policies::option_info>& notes);

} // namespace sofof::apps
