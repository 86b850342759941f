// Prints options as a TOML file.
#pragma once

#include "base/options/settings.hpp"

#include <functional>
#include <string>

namespace sofof {

/// @returns TOML that loads again to exactly the options that `list` lists,
/// defaults included. The same options always give the same bytes.
std::string print_settings(const std::function<void(settings&)>& list);

} // namespace sofof
