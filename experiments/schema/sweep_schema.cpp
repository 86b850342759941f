// The JSON schema of sweep files.
#include "experiments/schema/sweep_schema.hpp"

#include "experiments/schema/json_schema.hpp"
#include "experiments/sweep/plan.hpp"
#include "experiments/sweep/plan_keys.hpp"

#include <cassert>
#include <map>
#include <span>
#include <string_view>

namespace sofof::experiments::schema {

namespace {

using nlohmann::ordered_json;
using properties = std::map<std::string_view, ordered_json>;

/// @param what  A schema for each of the keys.
ordered_json table_with(std::span<const sweep_key> keys, properties what,
                        std::initializer_list<std::string_view> required) {
  ordered_json made{{"type", "object"}, {"properties", ordered_json::object()}};
  for (const auto& key : keys) {
    auto& one = made["properties"][std::string{key.name}];
    one["description"] = key.meaning;
    assert(what.contains(key.name));
    one.update(what[key.name]);
  }
  made["additionalProperties"] = false;
  made["required"] = ordered_json(required);
  return made;
}

ordered_json list_with(ordered_json items) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", 1}};
}

ordered_json either(ordered_json a, ordered_json b) {
  ordered_json made;
  made["anyOf"] = ordered_json::array({std::move(a), std::move(b)});
  return made;
}

} // namespace

ordered_json sweep_schema(const option_table& scenario) {
  const ordered_json text{{"type", "string"}, {"minLength", 1}};
  const ordered_json count{
      {"type", "integer"}, {"minimum", 1}, {"maximum", most_sweep_points}};
  const ordered_json number{{"type", "number"}};
  auto whole = list_with({{"type", "integer"}});
  whole["uniqueItems"] = true;
  const auto any = list_with(ordered_json::object());
  auto definitions = ordered_json::object();
  auto changes = changes_schema(scenario, definitions);
  definitions["changes"] = std::move(changes);
  definitions["key"] = {{"type", "string"},
                        {"pattern", path_pattern(scenario)}};
  const ordered_json set{{"$ref", "#/definitions/changes"}};
  const ordered_json key{{"$ref", "#/definitions/key"}};
  const auto as_all = [](const ordered_json& x) {
    ordered_json made;
    made["allOf"] = ordered_json::array({x});
    return made;
  };
  const auto value = table_with(
      wide_value_keys, {{"name", text}, {"set", as_all(set)}}, {"name", "set"});
  const auto axis = either(
      table_with(axis_keys,
                 {{"name", text}, {"key", as_all(key)}, {"values", any}},
                 {"key", "values"}),
      table_with(wide_axis_keys, {{"name", text}, {"value", list_with(value)}},
                 {"name", "value"}));
  const auto draw = either(
      table_with(drawn_value_keys, {{"key", as_all(key)}, {"values", any}},
                 {"key", "values"}),
      table_with(drawn_number_keys,
                 {{"key", as_all(key)}, {"from", number}, {"to", number}},
                 {"key", "from", "to"}));
  ordered_json made;
  made["$schema"] = "http://json-schema.org/draft-07/schema#";
  made["title"] = "A sweep of SOFOF";
  made.update(
      table_with(sweep_keys,
                 {{"name", {{"type", "string"}, {"pattern", "^[^/\\\\]+$"}}},
                  {"scenario", text},
                  {"seeds", either(count, whole)},
                  {"most_seeds", either(count, list_with(count))},
                  {"set", as_all(set)},
                  {"axis", list_with(axis)},
                  {"draw", list_with(draw)}},
                 {"name", "scenario"}));
  made["definitions"] = std::move(definitions);
  return made;
}

} // namespace sofof::experiments::schema
