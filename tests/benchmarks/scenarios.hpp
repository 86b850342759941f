// The scenarios that we measure.
#pragma once

#include "scenario/load.hpp"

#include <string>
#include <vector>

namespace sofof::benchmarks {

inline scenario::scenario_definition
ulm_lehr(const std::vector<std::string>& overrides = {}) {
  return scenario::load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml",
                                 overrides);
}

inline scenario::scenario_definition
scale(const std::vector<std::string>& overrides = {}) {
  return scenario::load_scenario(SOFOF_SOURCE_DIR "/config/scale.toml",
                                 overrides);
}

} // namespace sofof::benchmarks
