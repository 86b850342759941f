// Compares TOML by its leaves.
#include "experiments/report/options.hpp"

#include "base/options/toml_nodes.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <map>
#include <sstream>
#include <string>

namespace sofof::experiments::report {

namespace {

using leaves = std::map<std::string, std::string>;

void collect(const toml::node& from, const std::string& name, leaves& to) {
  const auto below = [&name](std::string_view part) {
    return name.empty() ? std::string{part} : fmt::format("{}.{}", name, part);
  };
  if (const auto* table = from.as_table()) {
    for (const auto& [key, value] : *table)
      collect(value, below(key.str()), to);
  } else if (const auto* list = from.as_array();
             list && list->is_array_of_tables()) {
    for (std::size_t i = 0; i < list->size(); ++i)
      collect(*list->get(i), below(std::to_string(i)), to);
  } else if (const auto* quoted = from.as_string()) {
    to[name] = quoted->get();
  } else {
    std::ostringstream text;
    from.visit([&text](const auto& value) { text << value; });
    to[name] = text.str();
  }
}

leaves leaves_of(std::string_view text) {
  leaves all;
  collect(parse_toml(text, "config.toml"), "", all);
  return all;
}

std::string value_in(const leaves& all, const std::string& name) {
  const auto found = all.find(name);
  return found == all.end() ? "–" : found->second;
}

} // namespace

table differing_options(std::string_view first, std::string_view second) {
  const auto ours = leaves_of(first);
  const auto theirs = leaves_of(second);
  auto names = ours;
  names.insert(theirs.begin(), theirs.end());
  table differing;
  for (const auto& [name, any] : names) {
    auto one = value_in(ours, name);
    auto other = value_in(theirs, name);
    if (one != other)
      differing.rows.push_back({name, std::move(one), std::move(other)});
  }
  return differing;
}

} // namespace sofof::experiments::report
