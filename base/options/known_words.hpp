// Reads back which words a refusal says are known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// The reverse of `unknown_word`.
/// @param why  A sentence on a word that is not known.
/// @returns the words that it says are known; none for any other sentence.
std::vector<std::string> known_words(std::string_view why);

} // namespace sofof
