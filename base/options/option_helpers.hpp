// What several lists of options have in common.
#pragma once

#include "base/geometry.hpp"
#include "base/options/option_visitor.hpp"
#include "base/options/spelling.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Lists a list of tables, each of which has `visit_options`.
template <class T>
void visit_list(option_visitor& s, std::string_view key,
                std::vector<T>& items) {
  s.tables(key, items.size(), [&](std::size_t i, option_visitor& t) {
    if (i == items.size())
      items.emplace_back();
    items[i].visit_options(t);
  });
}

/// Lists an object whose type hangs on its `name`, and its options.
/// @param object  Null if it has no default; then the name must be there.
/// @param make    From a name to a pointer, null for an unknown name.
/// @param what    E.g. "LODM policy".
/// @param known   All names.
/// @param hint    From an unknown name to a sentence on where it belongs, or
///                to nothing.
template <class Pointer, class Make>
void visit_choice(
    option_visitor& s, Pointer& object, Make make, std::string_view what,
    const std::vector<std::string_view>& known,
    const std::function<std::string(std::string_view name)>& hint = {}) {
  std::string name{object ? object->name() : ""};
  s.field("name", name);
  if (!object || object->name() != name) {
    Pointer made = make(name);
    if (!made) {
      const auto more = hint ? hint(name) : std::string{};
      return s.refuse("name", unknown_word(what, name, known)
                                  + (more.empty() ? "" : " " + more));
    }
    object = std::move(made);
  }
  object->visit_options(s);
}

/// An option whose value is one of a few words.
/// @param what   E.g. "placement".
/// @param known  All words.
template <class Words>
void visit_word(option_visitor& s, std::string_view key, std::string& value,
                std::string_view what, const Words& known) {
  s.field(key, value);
  if (std::ranges::find(known, value) == std::ranges::end(known))
    s.refuse(key, unknown_word(what, value, known));
}

/// Refuses corners that are no simple polygon.
inline void refuse_bad_polygon(option_visitor& s, std::string_view key,
                               const std::vector<point>& corners) {
  try {
    polygon{corners};
  } catch (const std::invalid_argument& problem) {
    s.refuse(key, problem.what());
  }
}

} // namespace sofof
