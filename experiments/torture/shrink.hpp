// Makes a scenario small that breaks a promise.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace sofof::experiments::torture {

/// @returns whether a scenario, as text, still shows what is looked for; not
/// for one that cannot be loaded.
using still_shows = std::function<bool(const std::string& text)>;

/// What became of it.
struct shrunk {
  std::string text;      ///< The smallest that was found; of no comments.
  std::size_t tries = 0; ///< How many scenarios were tried.
};

/// Makes the run shorter, then takes out whatever is not needed, the largest
/// parts first: tables, list elements and keys, which fall back to their
/// defaults; in the end no single one can be taken out.
/// Source: hierarchical delta debugging, Misherghi & Su, ICSE 2006.
/// @param text  A scenario for which `shows` is true.
/// @param most  How many scenarios are tried at most.
shrunk shrink(std::string_view text, const still_shows& shows,
              std::size_t most);

} // namespace sofof::experiments::torture
