// Reads tables of pages in Markdown.
#include "experiments/report/documented.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace sofof::experiments::report {

namespace {

/// @returns what stands before `end`, and removes both from `text`.
std::string_view cut(std::string_view& text, std::string_view end) {
  const auto at = text.find(end);
  const auto before = text.substr(0, at);
  text = at == text.npos ? std::string_view{} : text.substr(at + end.size());
  return before;
}

std::string_view section_of(std::string_view page, std::string_view heading) {
  cut(page, fmt::format("\n## {}\n", heading));
  return cut(page, "\n## ");
}

/// @param pattern  A name with {alternatives,one,two}, and <something> or {…}
///                 for any.
bool names(std::string_view pattern, std::string_view name) {
  if (pattern.empty())
    return name.empty();
  const auto first = pattern.front();
  if (first != '{' && first != '<')
    return !name.empty() && name.front() == first
           && names(pattern.substr(1), name.substr(1));
  auto rest = pattern.substr(1);
  auto list = cut(rest, first == '{' ? "}" : ">");
  if (first == '<' || list == "…") {
    for (std::size_t length = 1; length <= name.size(); ++length)
      if (names(rest, name.substr(length)))
        return true;
    return false;
  }
  while (!list.empty()) {
    const auto one = cut(list, ",");
    if (name.starts_with(one) && names(rest, name.substr(one.size())))
      return true;
  }
  return false;
}

/// @param cell  Names between backquotes.
bool has_name(std::string_view cell, std::string_view name) {
  while (true) {
    cut(cell, "`");
    if (cell.empty())
      return false;
    if (names(cut(cell, "`"), name))
      return true;
  }
}

std::string row_of(std::string_view section, std::string_view name) {
  while (!section.empty()) {
    auto line = cut(section, "\n");
    if (!line.starts_with("| `"))
      continue;
    line.remove_prefix(2);
    if (has_name(cut(line, " | "), name))
      return plain_text(cut(line, " |"));
  }
  return {};
}

} // namespace

std::string plain_text(std::string_view cell) {
  std::string text;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    if (cell[i] == ']' && cell.substr(i + 1).starts_with('('))
      i = std::min(cell.find(')', i), cell.size());
    else if (cell[i] != '`' && cell[i] != '*' && cell[i] != '[')
      text += cell[i];
  }
  while (!text.empty() && text.back() == ' ')
    text.pop_back();
  return text;
}

std::string documented_in(std::string_view page, std::string_view heading,
                          std::string_view name) {
  return row_of(section_of(page, heading), name);
}

std::string documented(std::string_view heading, std::string_view name) {
  for (const auto& known :
       {std::string{name}, fmt::format("services.any.{}", name)})
    if (auto text = documented_in(results_page, heading, known); !text.empty())
      return text;
  const auto dot = name.rfind('.');
  return dot == name.npos ? "" : documented(heading, name.substr(0, dot));
}

} // namespace sofof::experiments::report
