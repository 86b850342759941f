// Prints options as a TOML file.
#pragma once

#include "base/options/option_visitor.hpp"

#include <functional>
#include <string>

namespace sofof {

/// @returns TOML that loads again to exactly the options that `list` lists,
/// defaults included. The same options always give the same bytes.
std::string print_options(const std::function<void(option_visitor&)>& list);

} // namespace sofof
