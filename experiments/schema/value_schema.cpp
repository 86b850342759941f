// JSON schemas of options that are no tables.
#include "experiments/schema/value_schema.hpp"

#include <cassert>
#include <cmath>

namespace sofof::experiments::schema {

namespace {

using nlohmann::ordered_json;

/// Durations as `parse_duration` takes them.
/// @param least  The sign and zero hang on it.
std::string duration_pattern(duration least) {
  constexpr auto unit = "(h|min|s|ms|us|ns)$";
  constexpr auto any = "[0-9]+(\\.[0-9]+)?";
  constexpr auto positive =
      "([0-9]*[1-9][0-9]*(\\.[0-9]+)?|0+\\.[0-9]*[1-9][0-9]*)";
  if (least < duration{0})
    return std::string{"^-?"} + any + unit;
  return std::string{"^"} + (least > duration{0} ? positive : any) + unit;
}

/// A whole number is written as one.
ordered_json bound(double limit) {
  constexpr double exact = 1e15;
  if (limit == std::floor(limit) && std::abs(limit) < exact)
    return static_cast<std::int64_t>(limit);
  return limit;
}

void put_range(ordered_json& made, option_visitor::range r, double beyond) {
  constexpr option_visitor::range any;
  if (r.min > any.min)
    made["minimum"] = bound(r.min);
  if (r.max < any.max && r.max < beyond)
    made["maximum"] = bound(r.max);
}

ordered_json point_schema() {
  return {{"type", "array"},
          {"items", {{"type", "number"}}},
          {"minItems", 2},
          {"maxItems", 2}};
}

ordered_json bare(const described_option& option) {
  constexpr double no_number_beyond = 1e300;
  constexpr double no_integer_beyond = 0x1p63;
  ordered_json made;
  switch (option.kind) {
    case option_kind::flag:
      return {{"type", "boolean"}};
    case option_kind::number:
      made["type"] = "number";
      put_range(made, option.range, no_number_beyond);
      return made;
    case option_kind::whole_number:
      made["type"] = "integer";
      put_range(made, option.range, no_integer_beyond);
      return made;
    case option_kind::text:
      made["type"] = "string";
      if (!option.words.empty())
        made["enum"] = option.words;
      return made;
    case option_kind::time:
      return {{"type", "string"}, {"pattern", duration_pattern(option.least)}};
    case option_kind::texts:
      return {{"type", "array"}, {"items", {{"type", "string"}}}};
    case option_kind::point:
      return point_schema();
    case option_kind::points:
      return {{"type", "array"}, {"items", point_schema()}};
    default:
      assert(false);
      return made;
  }
}

} // namespace

ordered_json value_schema(const described_option& option) {
  assert(!option.table);
  auto made = bare(option);
  if (!option.instead.empty()) {
    ordered_json either;
    either["anyOf"] = ordered_json::array({made, {{"const", option.instead}}});
    made = std::move(either);
  }
  if (!option.standard.empty())
    made["default"] = ordered_json::parse(option.standard, nullptr, false);
  if (made.contains("default") && made["default"].is_discarded())
    made.erase("default"); // no value that JSON has
  return made;
}

} // namespace sofof::experiments::schema
