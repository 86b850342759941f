// Compares TOML by its leaves.
#include "experiments/report/options.hpp"

#include "base/options/toml_nodes.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
    if (const auto* number = from.as_floating_point()) {
      to[name] = fmt::format("{}", number->get());
      return;
    }
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

table differing_options(std::span<const std::string_view> texts) {
  std::vector<leaves> all;
  leaves names;
  for (const auto text : texts) {
    all.push_back(leaves_of(text));
    names.insert(all.back().begin(), all.back().end());
  }
  table differing;
  for (const auto& [name, any] : names) {
    std::vector<std::string> row{name};
    for (const auto& one : all)
      row.push_back(value_in(one, name));
    if (std::ranges::any_of(row.begin() + 2, row.end(),
                            [&row](const auto& x) { return x != row[1]; }))
      differing.rows.push_back(std::move(row));
  }
  return differing;
}

} // namespace sofof::experiments::report
