// The kinds of files that people write for SOFOF, and their schemas.
#include "experiments/schema/file_schemas.hpp"

#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "experiments/schema/json_schema.hpp"
#include "experiments/schema/option_meanings.hpp"
#include "experiments/schema/sweep_schema.hpp"
#include "experiments/torture/tried_scenario.hpp"
#include "scenario/map_file.hpp"
#include "scenario/scenario.hpp"

#include <span>
#include <vector>

namespace sofof::experiments::schema {

namespace {

/// Lists what scenarios for `sofof torture` have besides.
void list_foul_play(option_visitor& s) {
  torture::lie_options lies;
  torture::hostile_options hostile;
  if (s.has("lies", false))
    s.table("lies", [&](option_visitor& t) { lies.visit_options(t); });
  if (s.has("hostile", false))
    s.table("hostile", [&](option_visitor& t) { hostile.visit_options(t); });
}

/// @returns all that a scenario file can say, whoever reads it.
option_table written_options() {
  auto all = scenario_options();
  const auto more = describe_options(list_foul_play);
  auto& options = all.variants.front().options;
  const auto& others = more.variants.front().options;
  options.insert(options.end(), others.begin(), others.end());
  return all;
}

/// What an option of an entrant means.
std::string entrant_meaning(std::span<const std::string> path,
                            std::span<const std::string> names) {
  std::vector<std::string> whole{"policies"};
  whole.insert(whole.end(), path.begin(), path.end());
  return scenario_meaning(whole, names);
}

} // namespace

const option_table& scenario_options() {
  static const auto all = [] {
    scenario::scenario_definition made_up;
    return describe_options(
        [&](option_visitor& s) { made_up.visit_options(s); });
  }();
  return all;
}

const option_table& map_options() {
  static const auto all = describe_options(scenario::list_map_options);
  return all;
}

std::string schema_of(std::string_view kind) {
  constexpr auto indent = 1;
  const auto text = [](const nlohmann::ordered_json& made) {
    return made.dump(indent) + '\n';
  };
  if (kind == "scenario")
    return text(json_schema(written_options(), "A scenario of SOFOF",
                            scenario_meaning));
  if (kind == "map")
    return text(json_schema(map_options(), "A map of SOFOF", map_meaning));
  if (kind == "sweep")
    return text(sweep_schema(scenario_options()));
  if (kind == "entrants")
    return text(named_tables_schema(*scenario_options().find("policies")->table,
                                    "Entrants of sofof bench",
                                    entrant_meaning));
  throw input_error{
      unknown_word("kind of file with a schema", kind, file_kinds)};
}

} // namespace sofof::experiments::schema
