// From options to a JSON schema.
#include "experiments/schema/json_schema.hpp"

#include "experiments/schema/value_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>
#include <vector>

namespace sofof::experiments::schema {

namespace {

using nlohmann::ordered_json;

constexpr auto draft = "http://json-schema.org/draft-07/schema#";
constexpr std::string_view in_definitions = "#/definitions/";

ordered_json any_of(std::vector<ordered_json> all) {
  if (all.size() == 1)
    return std::move(all.front());
  ordered_json either;
  either["anyOf"] = std::move(all);
  return either;
}

ordered_json list_of(ordered_json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

ordered_json table_of(ordered_json properties) {
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false}};
}

/// Writes down each schema of a table once; others refer to it.
class schema_writer {
public:
  schema_writer(const meaning_of& meaning, ordered_json& definitions)
      : meaning_{meaning}, definitions_{definitions} {}

  /// @returns what a table must be, in full.
  ordered_json full(const option_table& table) {
    std::vector<ordered_json> all;
    if (auto name = name_alone(table); !name.is_null())
      all.push_back(std::move(name));
    for (const auto& variant : table.variants)
      all.push_back(variant_schema(variant));
    return any_of(std::move(all));
  }

  /// A text stands for a table with that name and nothing else.
  static ordered_json name_alone(const option_table& table) {
    std::vector<std::string> names;
    for (const auto& variant : table.variants)
      names.insert(names.end(), variant.names.begin(), variant.names.end());
    std::ranges::sort(names);
    if (!names.empty())
      return {{"type", "string"}, {"enum", names}};
    const auto* name = table.find("name");
    return name ? value_schema(*name) : ordered_json{};
  }

private:
  ordered_json variant_schema(const option_table::variant& variant) {
    ordered_json properties = ordered_json::object();
    const described_option* name = nullptr;
    for (const auto& option : variant.options) {
      properties[option.key] = option_schema(option, variant.names);
      if (option.key == "name")
        name = &option;
    }
    auto made = table_of(std::move(properties));
    if (!variant.only_with.empty())
      made["required"] = ordered_json::array({"name", variant.only_with});
    if (variant.names.empty())
      return made;
    assert(name);
    made["properties"]["name"]["enum"] = variant.names;
    const auto is_default = [name](const std::string& x) {
      return name->standard == '"' + x + '"';
    };
    if (std::ranges::none_of(variant.names, is_default))
      made["required"] = ordered_json::array({"name"});
    return made;
  }

  ordered_json option_schema(const described_option& option,
                             const std::vector<std::string>& names) {
    path_.push_back(option.key);
    auto made = ordered_json::object();
    auto meaning = meaning_(path_, names.empty() ? around_ : names);
    if (!option.now.empty())
      meaning = fmt::format("This is {} now.", option.now);
    if (!meaning.empty())
      made["description"] = meaning;
    if (!option.table) {
      made.update(value_schema(option));
    } else {
      if (!option.now.empty())
        path_.back() = option.now; // so that both refer to the same
      auto inside = referred(*option.table, names);
      if (option.kind == option_kind::tables)
        made.update(list_of(std::move(inside)));
      else
        made["allOf"] = ordered_json::array({std::move(inside)});
    }
    if (!option.now.empty())
      made["deprecated"] = true;
    path_.pop_back();
    return made;
  }

  /// @returns a reference to what a table must be.
  /// @param names  Of the variant that it is in: what is in it may mean
  ///               something else there.
  ordered_json referred(const option_table& table,
                        const std::vector<std::string>& names) {
    around_ = names;
    auto made = full(table);
    auto& name = names_[made.dump()];
    if (name.empty()) {
      name = fmt::format("{}", fmt::join(path_, "."));
      for (int more = 2; definitions_.contains(name); ++more)
        name = fmt::format("{}.{}", fmt::join(path_, "."), more);
      definitions_[name] = std::move(made);
    }
    return {{"$ref", fmt::format("{}{}", in_definitions, name)}};
  }

  const meaning_of& meaning_;
  ordered_json& definitions_;
  std::vector<std::string> path_;
  std::vector<std::string> around_; ///< Names of the variant around a table.
  std::map<std::string, std::string> names_; ///< Of a schema's text.
};

/// @returns all options of a table, whatever it is called, each once.
std::vector<const described_option*> options_of(const option_table& table) {
  std::vector<const described_option*> all;
  for (const auto& variant : table.variants)
    for (const auto& option : variant.options)
      if (std::ranges::find(
              all, option.key, [](const auto* x) -> auto& { return x->key; })
          == all.end())
        all.push_back(&option);
  return all;
}

/// @returns for paths below a table, alternatives without a sign for their
/// begin or end.
std::string alternatives(const option_table& table) {
  constexpr std::string_view element = "\\.[^.]+"; // by number or by name
  std::string all;
  for (const auto* option : options_of(table)) {
    all += (all.empty() ? "" : "|") + option->key;
    if (option->kind == option_kind::table)
      all += fmt::format("(\\.({}))?", alternatives(*option->table));
    else if (option->kind == option_kind::tables)
      all +=
          fmt::format("({}(\\.({}))?)?", element, alternatives(*option->table));
    else if (option->kind == option_kind::texts
             || option->kind == option_kind::point)
      all += "(\\.[0-9]+)?";
    else if (option->kind == option_kind::points)
      all += "(\\.[0-9]+){0,2}";
  }
  return all;
}

/// A table that changes options of a table.
ordered_json changes_of(const option_table& table, schema_writer& writer);

ordered_json change_of(const described_option& option, schema_writer& writer) {
  if (!option.table)
    return value_schema(option);
  std::vector<ordered_json> either;
  if (auto name = schema_writer::name_alone(*option.table); !name.is_null())
    either.push_back(std::move(name));
  either.push_back(changes_of(*option.table, writer));
  auto one = any_of(std::move(either));
  if (option.kind == option_kind::table)
    return one;
  return any_of({list_of(writer.full(*option.table)),
                 {{"type", "object"}, {"additionalProperties", one}}});
}

ordered_json changes_of(const option_table& table, schema_writer& writer) {
  ordered_json properties = ordered_json::object();
  for (const auto* option : options_of(table))
    properties[option->key] = change_of(*option, writer);
  auto made = table_of(std::move(properties));
  made["patternProperties"][path_pattern(table)] = ordered_json::object();
  return made;
}

} // namespace

ordered_json json_schema(const option_table& all, std::string_view title,
                         const meaning_of& meaning) {
  ordered_json made;
  made["$schema"] = draft;
  made["title"] = title;
  auto definitions = ordered_json::object();
  assert(all.variants.size() == 1);
  auto whole = schema_writer{meaning, definitions}.full(
      option_table{{all.variants.front()}});
  // A file is a table, and no text.
  made.update(whole.contains("anyOf") ? whole["anyOf"].back() : whole);
  made["definitions"] = std::move(definitions);
  return made;
}

ordered_json named_tables_schema(const option_table& each,
                                 std::string_view title,
                                 const meaning_of& meaning) {
  ordered_json made;
  made["$schema"] = draft;
  made["title"] = title;
  made["type"] = "object";
  auto definitions = ordered_json::object();
  made["additionalProperties"] = schema_writer{meaning, definitions}.full(each);
  made["definitions"] = std::move(definitions);
  return made;
}

ordered_json changes_schema(const option_table& all,
                            ordered_json& definitions) {
  const meaning_of nothing = [](auto, auto) { return std::string{}; };
  schema_writer writer{nothing, definitions};
  return changes_of(all, writer);
}

std::string path_pattern(const option_table& all) {
  return fmt::format("^({})$", alternatives(all));
}

} // namespace sofof::experiments::schema
