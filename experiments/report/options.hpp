// The options in which configurations differ.
#pragma once

#include "experiments/report/document.hpp"

#include <span>
#include <string_view>

namespace sofof::experiments::report {

/// @param texts  Right TOML, each a column.
/// @returns a table of options by their dotted names; what does not stand in
/// one of them has a dash there.
table differing_options(std::span<const std::string_view> texts);

} // namespace sofof::experiments::report
