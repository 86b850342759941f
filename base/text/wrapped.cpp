// Words into lines, greedily.
#include "base/text/wrapped.hpp"

#include <algorithm>
#include <cassert>

namespace sofof {

namespace {

std::size_t columns_of(std::string_view word) {
  const auto begins = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  };
  return static_cast<std::size_t>(std::ranges::count_if(word, begins));
}

} // namespace

// What leads a line stays, as do spaces between words that share a line.
std::string wrapped(std::string_view text, std::size_t width,
                    std::size_t indent) {
  assert(indent < width);
  std::string out;
  std::size_t column = 0;
  bool begun = false; // a word stands in this line
  while (!text.empty()) {
    if (text.front() == '\n') {
      out += '\n';
      text.remove_prefix(1);
      column = 0;
      begun = false;
      continue;
    }
    const auto gap = std::min(text.find_first_not_of(' '), text.size());
    const auto rest = text.substr(gap);
    const auto word = rest.substr(0, rest.find_first_of(" \n"));
    const auto length = columns_of(word);
    if (begun && column + gap + length > width) {
      out += '\n' + std::string(indent, ' ');
      column = indent;
    } else {
      out += text.substr(0, gap);
      column += gap;
    }
    out += word;
    column += length;
    begun = begun || !word.empty();
    text = rest.substr(word.size());
  }
  return out;
}

} // namespace sofof
