// An option that has moved within a file, brought to its new place.
#include "base/options/moved_option.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_options.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace sofof {

namespace {

/// A table, and one of its keys.
struct named_node {
  toml::table* table = nullptr; ///< Null if there is none.
  std::string_view key;

  toml::node* get() const { return table ? table->get(key) : nullptr; }
};

/// @param makes  Whether tables that are missing on the way are made.
named_node find_node(toml::table& root, std::string_view path, bool makes) {
  auto* table = &root;
  for (auto dot = path.find('.'); dot != path.npos; dot = path.find('.')) {
    const auto key = path.substr(0, dot);
    path.remove_prefix(dot + 1);
    if (makes && !table->contains(key))
      table->insert(key, toml::table{});
    auto* next = table->get(key);
    table = next ? next->as_table() : nullptr;
    if (!table)
      return {};
  }
  return {table, path};
}

bool is_from_command_line(const toml::node& node) {
  const auto& path = node.source().path;
  return path && path->starts_with(command_line_prefix);
}

class option_move {
public:
  option_move(std::string_view to, std::string_view file)
      : to_{to}, file_{file} {}

  /// @returns whether anything of it counts.
  bool apply(toml::node& what, const named_node& to,
             std::string_view from) const {
    assert(to.table);
    auto* there = to.get();
    auto* parts = what.as_table();
    if (!there) {
      what.visit(
          [&](auto& exact) { to.table->insert(to.key, std::move(exact)); });
    } else if (parts && there->is_table()) {
      auto counts = false;
      for (auto&& [key, part] : *parts)
        counts |= apply(part, {there->as_table(), key.str()}, key.str());
      return counts;
    } else if (is_from_command_line(what) == is_from_command_line(*there)) {
      throw input_error{fmt::format(
          "{}: {} stands at its new place, {}, too: {}. Remove one of them.",
          place_of(what.source(), file_), from, to_,
          place_of(there->source(), file_))};
    } else if (!is_from_command_line(what)) {
      return false;
    } else {
      what.visit([&](auto& exact) {
        to.table->insert_or_assign(to.key, std::move(exact));
      });
    }
    return true;
  }

private:
  std::string_view to_;
  std::string_view file_;
};

} // namespace

std::optional<former_place> move_option(toml::table& table,
                                        std::string_view from,
                                        std::string_view to,
                                        std::string_view file) {
  assert(!from.empty() && !to.empty());
  const auto old = find_node(table, from, false);
  auto* what = old.get();
  if (!what)
    return {};
  former_place found{place_of(what->source(), file)};
  const auto target = find_node(table, to, true);
  if (!target.table)
    return {};
  found.counts = option_move{to, file}.apply(*what, target, from);
  old.table->erase(old.key);
  return found;
}

} // namespace sofof
