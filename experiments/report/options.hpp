// The options in which two configurations differ.
#pragma once

#include "experiments/report/document.hpp"

#include <string_view>

namespace sofof::experiments::report {

/// @param first, second  Right TOML.
/// @returns a table of options by their dotted names; what stands in one of
/// them only has a dash for the other.
table differing_options(std::string_view first, std::string_view second);

} // namespace sofof::experiments::report
