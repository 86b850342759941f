// JSON schemas of options that are no tables.
#pragma once

#include "base/options/option_tree.hpp"

#include <nlohmann/json.hpp>

namespace sofof::experiments::schema {

/// @returns what a value of it must be, with its default. Precondition: it is
/// no table and no list of tables.
nlohmann::ordered_json value_schema(const described_option& option);

} // namespace sofof::experiments::schema
