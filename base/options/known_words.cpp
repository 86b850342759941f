// Reads back which words a refusal says are known.
#include "base/options/known_words.hpp"

namespace sofof {

std::vector<std::string> known_words(std::string_view why) {
  constexpr std::string_view begin = " Known: ", between = ", ";
  const auto at = why.find(begin);
  if (at == why.npos)
    return {};
  auto list = why.substr(at + begin.size());
  list = list.substr(0, list.find(". "));
  if (list.ends_with('.'))
    list.remove_suffix(1);
  std::vector<std::string> words;
  while (!list.empty()) {
    const auto end = list.find(between);
    words.emplace_back(list.substr(0, end));
    list = end == list.npos ? "" : list.substr(end + between.size());
  }
  return words;
}

} // namespace sofof
