// Checks a value by a JSON schema, as far as ours go: draft 7 without what they
// do not use.
#pragma once

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sofof::test {

/// @returns the value as JSON has it.
inline nlohmann::json json_of(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    auto all = nlohmann::json::object();
    for (const auto& [key, value] : *table)
      all[std::string{key.str()}] = json_of(value);
    return all;
  }
  if (const auto* list = node.as_array()) {
    auto all = nlohmann::json::array();
    for (const auto& value : *list)
      all.push_back(json_of(value));
    return all;
  }
  if (const auto text = node.value_exact<std::string>())
    return *text;
  if (const auto whole = node.value_exact<std::int64_t>())
    return *whole;
  if (const auto number = node.value_exact<double>())
    return *number;
  if (const auto flag = node.value_exact<bool>())
    return *flag;
  return nullptr; // a date
}

class schema_check {
public:
  using json = nlohmann::json;

  explicit schema_check(json schema) : root_(std::move(schema)) {}

  /// @returns what is wrong with a value, and where; empty if nothing.
  std::string operator()(const json& value) { return check(root_, value, ""); }

private:
  using place = const std::string&;

  std::string check(const json& schema, const json& value, place at) {
    for (const auto& [word, what] : schema.items()) {
      const auto i = std::ranges::find(rules, word, &rule::word);
      if (i == std::end(rules))
        throw std::logic_error{"nobody here knows the keyword " + word};
      if (i->holds)
        if (auto wrong = (this->*i->holds)(what, schema, value, at);
            !wrong.empty())
          return wrong;
    }
    return {};
  }

  static bool is(const json& value, std::string_view type) {
    return type == "object"    ? value.is_object()
           : type == "array"   ? value.is_array()
           : type == "string"  ? value.is_string()
           : type == "boolean" ? value.is_boolean()
           : type == "integer" ? value.is_number_integer()
                               : value.is_number();
  }

  std::string type(const json& what, const json&, const json& value, place at) {
    return is(value, what.get<std::string>())
               ? ""
               : fmt::format("{}: is no {}", at, what.get<std::string>());
  }
  std::string one_of(const json& what, const json&, const json& value,
                     place at) {
    return std::ranges::find(what, value) != what.end()
               ? ""
               : fmt::format("{}: is none of the words", at);
  }
  std::string constant(const json& what, const json&, const json& value,
                       place at) {
    return value == what ? "" : fmt::format("{}: is another word", at);
  }
  std::string minimum(const json& what, const json&, const json& value,
                      place at) {
    return !value.is_number() || value.get<double>() >= what.get<double>()
               ? ""
               : fmt::format("{}: is too small", at);
  }
  std::string maximum(const json& what, const json&, const json& value,
                      place at) {
    return !value.is_number() || value.get<double>() <= what.get<double>()
               ? ""
               : fmt::format("{}: is too large", at);
  }
  std::string least_items(const json& what, const json&, const json& value,
                          place at) {
    return !value.is_array() || value.size() >= what.get<std::size_t>()
               ? ""
               : fmt::format("{}: has too few elements", at);
  }
  std::string most_items(const json& what, const json&, const json& value,
                         place at) {
    return !value.is_array() || value.size() <= what.get<std::size_t>()
               ? ""
               : fmt::format("{}: has too many elements", at);
  }
  std::string least_length(const json& what, const json&, const json& value,
                           place at) {
    return !value.is_string()
                   || value.get<std::string>().size() >= what.get<std::size_t>()
               ? ""
               : fmt::format("{}: is too short", at);
  }
  std::string unique(const json&, const json&, const json& value, place at) {
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (value[i] == value[k])
          return fmt::format("{}: stands there twice", at);
    return {};
  }
  bool matches(const std::string& pattern, const std::string& text) {
    const auto known = patterns_.try_emplace(pattern, pattern).first;
    return std::regex_search(text, known->second);
  }
  std::string pattern(const json& what, const json&, const json& value,
                      place at) {
    return !value.is_string()
                   || matches(what.get<std::string>(), value.get<std::string>())
               ? ""
               : fmt::format("{}: does not match", at);
  }
  std::string items(const json& what, const json&, const json& value,
                    place at) {
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
      if (auto wrong = check(what, value[i], fmt::format("{}.{}", at, i));
          !wrong.empty())
        return wrong;
    return {};
  }
  std::string properties(const json& what, const json&, const json& value,
                         place at) {
    for (const auto& [key, inner] : what.items())
      if (value.is_object() && value.contains(key))
        if (auto wrong =
                check(inner, value[key], fmt::format("{}.{}", at, key));
            !wrong.empty())
          return wrong;
    return {};
  }
  std::string others(const json& what, const json& schema, const json& value,
                     place at) {
    if (!value.is_object())
      return {};
    for (const auto& [key, inner] : value.items()) {
      const auto& text = key;
      if (schema.value("properties", json::object()).contains(key))
        continue;
      auto fits = false;
      if (schema.contains("patternProperties"))
        for (const auto& [pattern, any] : schema["patternProperties"].items())
          fits = fits || matches(pattern, text);
      if (fits)
        continue;
      if (what.is_boolean())
        return fmt::format("{}.{}: is not known", at, key);
      if (auto wrong = check(what, inner, fmt::format("{}.{}", at, key));
          !wrong.empty())
        return wrong;
    }
    return {};
  }
  std::string required(const json& what, const json&, const json& value,
                       place at) {
    for (const auto& key : what)
      if (value.is_object() && !value.contains(key.get<std::string>()))
        return fmt::format("{}: lacks {}", at, key.get<std::string>());
    return {};
  }
  std::string any_of(const json& what, const json&, const json& value,
                     place at) {
    std::string wrong;
    for (const auto& one : what)
      if (wrong = check(one, value, at); wrong.empty())
        return {};
    return wrong;
  }
  std::string all_of(const json& what, const json&, const json& value,
                     place at) {
    for (const auto& one : what)
      if (auto wrong = check(one, value, at); !wrong.empty())
        return wrong;
    return {};
  }
  std::string referred(const json& what, const json&, const json& value,
                       place at) {
    const auto text = what.get<std::string>();
    constexpr std::string_view front = "#/definitions/";
    return check(root_.at("definitions").at(text.substr(front.size())), value,
                 at);
  }

  struct rule {
    std::string_view word;
    std::string (schema_check::*holds)(const json& what, const json& schema,
                                       const json& value, place at);
  };
  static const std::array<rule, 24> rules;

  json root_;
  std::map<std::string, std::regex, std::less<>> patterns_;
};

/// Those without a function say nothing of what a value must be.
inline const std::array<schema_check::rule, 24> schema_check::rules{
    {{"type", &schema_check::type},
     {"enum", &schema_check::one_of},
     {"const", &schema_check::constant},
     {"minimum", &schema_check::minimum},
     {"maximum", &schema_check::maximum},
     {"minItems", &schema_check::least_items},
     {"maxItems", &schema_check::most_items},
     {"minLength", &schema_check::least_length},
     {"uniqueItems", &schema_check::unique},
     {"pattern", &schema_check::pattern},
     {"items", &schema_check::items},
     {"properties", &schema_check::properties},
     {"patternProperties", nullptr}, // `others` asks them; they allow anything
     {"additionalProperties", &schema_check::others},
     {"required", &schema_check::required},
     {"anyOf", &schema_check::any_of},
     {"allOf", &schema_check::all_of},
     {"$ref", &schema_check::referred},
     {"$schema", nullptr},
     {"title", nullptr},
     {"description", nullptr},
     {"default", nullptr},
     {"deprecated", nullptr},
     {"definitions", nullptr}}};

} // namespace sofof::test
