// The JSON schema of sweep files.
#pragma once

#include "base/options/option_tree.hpp"

#include <nlohmann/json.hpp>

namespace sofof::experiments::schema {

/// @param scenario  All options of a scenario, which a sweep changes.
nlohmann::ordered_json sweep_schema(const option_table& scenario);

} // namespace sofof::experiments::schema
