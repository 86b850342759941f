// Makes a scenario small that breaks a promise.
#include "experiments/torture/shrink.hpp"

#include "base/options/toml_nodes.hpp"
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::experiments::torture {

namespace {

/// Keys and numbers of list elements, from the top on.
using step = std::variant<std::string, std::size_t>;
using way = std::vector<step>;

toml::node* child(toml::node& of, const step& where) {
  if (const auto* key = std::get_if<std::string>(&where))
    return of.as_table() ? of.as_table()->get(*key) : nullptr;
  return of.as_array() ? of.as_array()->get(std::get<std::size_t>(where))
                       : nullptr;
}

/// How long the run is; without it, it would be longer, not shorter.
constexpr std::string_view length_key = "duration";

/// Takes out what stands there; of a list so many in a row, the last of which
/// stands there. @returns whether it could.
bool take_out(toml::table& all, const way& where, std::size_t count) {
  toml::node* at = &all;
  for (std::size_t k = 0; k + 1 < where.size() && at; ++k)
    at = child(*at, where[k]);
  if (!at || !child(*at, where.back()))
    return false;
  if (const auto* key = std::get_if<std::string>(&where.back())) {
    if (count == 1)
      at->as_table()->erase(*key);
    return count == 1;
  }
  const auto last = std::get<std::size_t>(where.back());
  if (last + 1 < count)
    return false;
  auto& list = *at->as_array();
  const auto end = list.begin() + static_cast<std::ptrdiff_t>(last + 1);
  list.erase(end - static_cast<std::ptrdiff_t>(count), end);
  return true;
}

/// @returns all nodes, those near the top first, of a list the last first.
std::vector<way> nodes_of(toml::table& all) {
  std::vector<way> found;
  std::deque<std::pair<toml::node*, way>> waiting{{&all, {}}};
  while (!waiting.empty()) {
    const auto [node, where] = waiting.front();
    waiting.pop_front();
    const auto add = [&, at = where](step next, toml::node& inner) {
      auto there = at;
      there.push_back(std::move(next));
      found.push_back(there);
      waiting.emplace_back(&inner, std::move(there));
    };
    if (auto* table = node->as_table())
      for (auto&& [key, inner] : *table) {
        if (node == &all && key.str() == length_key)
          continue;
        add(std::string{key.str()}, inner);
      }
    else if (auto* list = node->as_array())
      for (auto k = list->size(); k-- > 0;)
        add(k, (*list)[k]);
  }
  return found;
}

class shrinker {
public:
  shrinker(std::string_view text, const still_shows& shows, std::size_t most)
      : best_(parse_toml(text, "torture.toml")), shows_{shows}, most_{most} {}

  shrunk work() {
    shorten();
    while (take_out_any())
      ;
    shorten();
    return {file_text(best_), tries_};
  }

private:
  bool keeps(toml::table changed) {
    if (tries_ == most_)
      return false;
    ++tries_;
    if (!shows_(file_text(changed)))
      return false;
    best_ = std::move(changed);
    return true;
  }

  /// Ends the run earlier, by large steps first.
  void shorten() {
    for (const auto part : {0.25, 0.5, 0.7, 0.9})
      for (;;) {
        const auto now =
            parse_duration(best_[length_key].value_or(std::string{"10min"}));
        const auto tenths =
            static_cast<std::int64_t>(to_seconds(*now) * part * 10);
        if (tenths < 1)
          return;
        auto shorter = best_;
        shorter.insert_or_assign(
            length_key, print_duration(tenths * duration{100'000'000}));
        if (!keeps(std::move(shorter)))
          break;
      }
  }

  /// One after the other, and then two in a row: services that need each other.
  /// @returns whether anything could be taken out.
  bool take_out_any() {
    bool any = false;
    for (const std::size_t count : {1, 2})
      for (const auto& where : nodes_of(best_)) {
        auto smaller = best_;
        if (take_out(smaller, where, count))
          any |= keeps(std::move(smaller));
      }
    return any && tries_ < most_;
  }

  toml::table best_;
  const still_shows& shows_;
  std::size_t most_;
  std::size_t tries_ = 0;
};

} // namespace

shrunk shrink(std::string_view text, const still_shows& shows,
              std::size_t most) {
  return shrinker{text, shows, most}.work();
}

} // namespace sofof::experiments::torture
