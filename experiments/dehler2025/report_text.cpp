// Reads templates, and fills them.
#include "experiments/dehler2025/report_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace sofof::experiments::study {

namespace {

constexpr std::string_view title_mark = "# ", part_mark = "## ";

/// @returns the first line of `rest`, which loses it.
std::string_view next_line(std::string_view& rest) {
  const auto line = rest.substr(0, rest.find('\n'));
  rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  return line;
}

} // namespace

report_text::report_text(std::string name, std::string_view template_text)
    : name_{std::move(name)} {
  std::string* part = nullptr;
  while (!template_text.empty()) {
    const auto line = next_line(template_text);
    if (line.starts_with(part_mark)) {
      const auto [at, is_new] =
          parts_.try_emplace(std::string{line.substr(part_mark.size())});
      if (!is_new || (part && part->empty()))
        throw std::logic_error{fmt::format(
            "{}: the part before or at '{}' is empty, or there twice", name_,
            line)};
      part = &at->second;
    } else if (part && !line.empty()) {
      *part += (part->empty() ? "" : " ") + std::string{line};
    } else if (!line.empty() && !line.starts_with(title_mark)) {
      throw std::logic_error{
          fmt::format("{}: '{}' belongs to no part", name_, line)};
    }
  }
  if (!part || part->empty())
    throw std::logic_error{
        fmt::format("{}: there is no part, or the last is empty", name_)};
}

report_text report_text::of(std::string_view name) {
  return {std::string{name}, template_of(name)};
}

std::string report_text::fill(const std::string& part,
                              const named_figures& figures) const {
  const auto found = parts_.find(part);
  if (found == parts_.end())
    throw std::logic_error{fmt::format("{}: there is no part {}", name_, part)};
  std::string filled;
  std::set<std::string_view> used;
  std::string_view rest = found->second;
  for (auto open = rest.find('{'); open != rest.npos; open = rest.find('{')) {
    filled += rest.substr(0, open);
    rest.remove_prefix(open + 1);
    const auto name = rest.substr(0, rest.find('}'));
    const auto figure = figures.find(name);
    if (figure == figures.end())
      throw std::logic_error{fmt::format("{}: nothing stands for {{{}}} in {}",
                                         name_, name, part)};
    filled += figure->second;
    used.insert(figure->first);
    rest.remove_prefix(std::min(name.size() + 1, rest.size()));
  }
  for (const auto& [name, value] : figures)
    if (!used.contains(name))
      throw std::logic_error{
          fmt::format("{}: {} does not mention {}", name_, part, name)};
  return filled.append(rest);
}

std::vector<std::string> report_text::parts() const {
  std::vector<std::string> names;
  for (const auto& [name, text] : parts_)
    names.push_back(name);
  return names;
}

std::string in_words(std::uint64_t count) {
  constexpr std::string_view words[] = {
      "no",    "one",   "two",  "three", "four",   "five",  "six",
      "seven", "eight", "nine", "ten",   "eleven", "twelve"};
  return count < std::size(words) ? std::string{words[count]}
                                  : std::to_string(count);
}

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", in_words(count), noun, count == 1 ? "" : "s");
}

std::string in_a_list(std::span<const std::int64_t> numbers) {
  constexpr std::size_t shown = 20;
  if (numbers.empty())
    return "none";
  auto list = fmt::format(
      "{}", fmt::join(numbers.first(std::min(shown, numbers.size())), ", "));
  if (numbers.size() > shown)
    list += fmt::format(", … ({} in all)", numbers.size());
  return list;
}

} // namespace sofof::experiments::study
