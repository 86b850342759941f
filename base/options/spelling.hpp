// Helps with a word that is not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace sofof {

/// @returns the known word with the fewest edits away from `word`, if it is
/// near enough to be meant; else an empty one.
std::string_view nearest_word(std::string_view word,
                              std::span<const std::string_view> known);

/// @returns that the quoted word is no such thing, which one was perhaps meant,
/// and which are known.
/// @param what  E.g. "LODM policy".
std::string unknown_word(std::string_view what, std::string_view word,
                         std::span<const std::string_view> known);

} // namespace sofof
