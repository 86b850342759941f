// Helps with a word that is not known.
#include "base/options/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace sofof {

namespace {

/// Longer words than this are not compared: nobody meant them.
constexpr std::size_t longest_word = 64;

/// Levenshtein's distance: characters to insert, delete or replace.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const auto c : a) {
    auto diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const auto replaced = diagonal + (c == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

} // namespace

std::string_view nearest_word(std::string_view word,
                              std::span<const std::string_view> known) {
  if (word.size() > longest_word)
    return {};
  std::string_view best;
  auto fewest = 2 + word.size() / 3; // this many is too far
  for (const auto k : known) {
    if (const auto n = edits(word, k); n < fewest) {
      fewest = n;
      best = k;
    }
  }
  return best;
}

std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known) {
  const auto meant = nearest_word(word, known);
  const auto hint =
      meant.empty() ? "" : fmt::format(", did you mean \"{}\"?", meant);
  return fmt::format("\"{}\" is no {}{} Known: {}.", word, what,
                     hint.empty() ? "." : hint, fmt::join(known, ", "));
}

} // namespace sofof
