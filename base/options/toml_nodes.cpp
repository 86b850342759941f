// From text to TOML nodes, and back on one line.
#include "base/options/toml_nodes.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_depth.hpp"
#include "base/options/toml_options.hpp"
#include "base/options/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace sofof {

namespace {

std::string key_text(std::string_view key) {
  const auto bare = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')
           || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !key.empty() && std::ranges::all_of(key, bare) ? std::string{key}
                                                        : quoted_toml(key);
}

std::string inline_text(const toml::table& table) {
  std::string text = "{";
  for (const auto& [key, value] : table)
    text += fmt::format("{}{} = {}", text.size() > 1 ? ", " : " ",
                        key_text(key.str()), value_text(value));
  return text + " }";
}

std::string inline_text(const toml::array& list) {
  std::string text = "[";
  for (const auto& value : list)
    text += (text.size() > 1 ? ", " : " ") + value_text(value);
  return text + " ]";
}

} // namespace

toml::table parse_toml(std::string_view text, std::string_view file) {
  check_toml_depth(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& problem) {
    throw input_error{fmt::format("{}: {}.", place_of(problem.source(), file),
                                  problem.description())};
  }
}

std::string value_text(const toml::node& value) {
  if (const auto* table = value.as_table())
    return inline_text(*table);
  if (const auto* list = value.as_array())
    return inline_text(*list);
  std::ostringstream text;
  value.visit([&](const auto& exact) {
    text << toml::toml_formatter{exact, toml::format_flags::none};
  });
  return text.str();
}

std::string file_text(const toml::table& all) {
  std::ostringstream text;
  text << toml::toml_formatter{all, toml::format_flags::none} << '\n';
  return std::move(text).str();
}

} // namespace sofof
