// A first scenario for a map.
#include "apps/propose.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "scenario/load.hpp"
#include "scenario/map_file.hpp"

#include <fmt/format.h>

#include "maps/proposal.hpp"
#include <filesystem>
#include <stdexcept>

namespace sofof::apps {

std::string proposed_text(const std::string& map, const std::string& name,
                          const std::string& out) {
  namespace fs = std::filesystem;
  const auto world = scenario::parse_map(require_text(map), map);
  const auto folder = fs::absolute(out).parent_path();
  const auto from_there = fs::absolute(map).lexically_relative(folder);
  try {
    auto text = maps::propose_scenario(*world, name, from_there.string());
    scenario::parse_scenario(text, out);
    return text;
  } catch (const std::invalid_argument& problem) {
    throw input_error{fmt::format("{}: {}", map, problem.what())};
  }
}

} // namespace sofof::apps
