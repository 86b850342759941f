// A scenario to try loading on: complete, right, and easily spoilt.
#pragma once

#include "base/input_error.hpp"
#include "scenario/load.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::example {

inline const std::string text = R"(name = "example"
duration = "600s"
seed = 7
map = "ring.toml"

[traffic]
crossings = "perceived"

[[fleet]]
count = 6
first_station = 101
routes = ["round_trip", "round_trip_opposite"]
placement = "equal"

[[fleet]]
count = 2
first_station = 201
routes = ["straight"]
placement = "convoy"
start_m = 150.0
start_speed_mps = 8.5
connected = false

[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 80.0

[[provider]]
name = "cloud"
area_m = [[0, 0], [50, 0], [50.5, 50], [0, 50]]
services = ["cabin_climate"]

[network]
profile = "paper_sim"

[[service]]
name = "trajectory_planning"
max_latency = "50ms"

[[service]]
name = "cabin_climate"

[policies]
lodm = { name = "location", radius_m = 250.0, min_distance_m = 50.0 }
codm = "always"

[record]
tracks_period = "250ms"
cycles = false
)";

inline const std::filesystem::path folder =
    std::filesystem::path{SOFOF_SOURCE_DIR} / "tests/scenario/data";

/// @returns the example with its first `from` replaced.
inline std::string with(std::string_view from, std::string_view to,
                        std::string in = text) {
  const auto at = in.find(from);
  if (at == in.npos)
    throw std::logic_error{"the example has no " + std::string{from}};
  return in.replace(at, from.size(), to);
}

/// Loads a text as if it were a file beside the test data.
inline scenario::scenario_definition
load(std::string_view what = text,
     const std::vector<std::string>& overrides = {}) {
  return scenario::parse_scenario(what, folder / "example.toml", overrides);
}

/// @returns what the loader says about a text; empty if it has no objection.
inline std::string error_of(std::string_view what,
                            const std::vector<std::string>& overrides = {}) {
  try {
    load(what, overrides);
    return {};
  } catch (const input_error& problem) {
    return problem.what();
  }
}

} // namespace sofof::example
