// What docs/scenarios.md and the notes of policies say of options.
#include "experiments/schema/option_meanings.hpp"

#include "experiments/report/documented.hpp"
#include "policies/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sofof::experiments::schema {

namespace {

constexpr std::string_view maps_begin = "\n# Map files\n";

/// @returns the texts between backquotes.
std::vector<std::string> quoted_words(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const auto begin = text.find('`');
    const auto end = begin == text.npos ? begin : text.find('`', begin + 1);
    if (end == text.npos)
      return words;
    words.emplace_back(text.substr(begin + 1, end - begin - 1));
    text.remove_prefix(end + 1);
  }
}

/// @returns "fleet.compute" of "[fleet.compute]" or "[[fleet.compute]]".
std::string header_name(std::string_view word) {
  while (word.starts_with('['))
    word.remove_prefix(1);
  return std::string{word.substr(0, word.find(']'))};
}

/// @returns what stands behind a table's header: "edge servers, also none".
std::string title_of(std::string_view line) {
  const auto begin = line.find("]`");
  if (begin == line.npos)
    return {};
  line.remove_prefix(begin + 2);
  line.remove_prefix(std::min(line.find_first_not_of(":, "), line.size()));
  auto text = report::plain_text(line);
  if (text.ends_with(':'))
    text.pop_back();
  return text;
}

/// @returns the last part of a path by dots.
std::string_view last_of_path(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == path.npos ? path : path.substr(dot + 1);
}

bool is_among(std::span<const std::string> all, std::string_view word) {
  return std::ranges::find(all, word) != all.end();
}

/// Whether one of the parts before the last one is among the words.
bool names_parent(std::span<const std::string> words, std::string_view path) {
  auto parents = path.substr(0, path.size() - last_of_path(path).size());
  if (parents.ends_with('.'))
    parents.remove_suffix(1);
  if (parents.empty())
    return false;
  return is_among(words, parents) || is_among(words, last_of_path(parents))
         || is_among(words, parents.substr(0, parents.find('.')));
}

/// @returns the note on an option of a policy, a filter or a governor.
std::string note_of(const std::vector<policies::policy_info>& all,
                    std::span<const std::string> names, std::string_view key) {
  for (const auto& name : names) {
    const auto one = std::ranges::find(all, name, &policies::policy_info::name);
    if (one == all.end())
      continue;
    const auto note =
        std::ranges::find(one->parameters, key, &policies::option_info::name);
    if (note != one->parameters.end())
      return std::string{note->meaning};
  }
  return {};
}

/// Of scenarios that `sofof torture` runs.
std::string foul_meaning(std::span<const std::string> path) {
  if (path.back() == "what")
    return "What services at providers say instead.";
  if (path.back() == "after")
    return "So long each session is honest.";
  return path.back() == "every" ? "So often the station says something."
                                : "Foul play, for sofof torture alone.";
}

std::string policy_meaning(std::span<const std::string> path,
                           std::span<const std::string> names) {
  const auto local = path[1] == "lodm";
  const auto& key = path.back();
  if (key == "name" || path.size() < 3)
    return {};
  if (key == "filter" || key == "govern")
    return key == "filter" ? "What it chooses among."
                           : "What has the last word, one after the other.";
  if (path.size() == 3)
    return note_of(local ? policies::lodm_notes() : policies::codm_notes(),
                   names, key);
  if (path[2] == "govern")
    return note_of(policies::governor_notes(), names, key);
  return note_of(local ? policies::local_filter_notes()
                       : policies::central_filter_notes(),
                 names, key);
}

} // namespace

documented_options::documented_options(std::string_view page) {
  std::string section;
  std::string paragraph;
  auto goes_on = false; // The line before belongs to the paragraph, too.
  while (!page.empty()) {
    const auto end = std::min(page.find('\n'), page.size());
    const auto line = page.substr(0, end);
    page.remove_prefix(std::min(end + 1, page.size()));
    if (line.starts_with("| `")) {
      const auto cell_end = line.find(" | ");
      auto meaning = line.substr(0, line.rfind('|'));
      meaning.remove_prefix(meaning.rfind('|') + 1);
      meaning.remove_prefix(
          std::min(meaning.find_first_not_of(' '), meaning.size()));
      rows_.push_back({section, quoted_words(paragraph),
                       quoted_words(line.substr(0, cell_end)),
                       report::plain_text(meaning)});
      continue;
    }
    if (line.empty() || line.starts_with('|')) {
      goes_on = false;
      continue;
    }
    paragraph = goes_on ? fmt::format("{} {}", paragraph, line) : line;
    const auto words = quoted_words(line);
    const auto begins = line.starts_with('#')
                            ? line.find("`[") != line.npos
                            : !goes_on && line.starts_with("`[[");
    if (begins) {
      section = header_name(words.front());
      titles_.emplace(section, title_of(line));
    } else if (line.starts_with('#')) {
      section.clear();
    }
    goes_on = !line.starts_with('#');
  }
}

std::string
documented_options::in_section(std::string_view section, std::string_view rest,
                               std::span<const std::string> names) const {
  const auto last = last_of_path(rest);
  const auto of_names = [&names](const row& x) {
    return std::ranges::any_of(
        x.context, [&](const auto& word) { return is_among(names, word); });
  };
  const auto exact = [rest](const row& x) { return is_among(x.keys, rest); };
  const auto in_parent = [rest, last](const row& x) {
    return is_among(x.keys, last) && names_parent(x.context, rest);
  };
  const auto find = [&](const auto& fits) -> std::string {
    const auto i = std::ranges::find_if(rows_, [&](const row& x) {
      return x.section == section && !x.meaning.empty() && fits(x);
    });
    return i == rows_.end() ? std::string{} : i->meaning;
  };
  auto text = find([&](const row& x) { return of_names(x) && exact(x); });
  if (text.empty())
    text = find(in_parent);
  return text.empty() ? find(exact) : text;
}

std::string documented_options::of(std::span<const std::string> path,
                                   std::span<const std::string> names) const {
  const auto whole = fmt::format("{}", fmt::join(path, "."));
  if (const auto title = titles_.find(whole); title != titles_.end())
    return title->second;
  for (auto in_front = path.size(); in_front-- > 0;) {
    const auto section =
        fmt::format("{}", fmt::join(path.first(in_front), "."));
    const auto rest = fmt::format("{}", fmt::join(path.subspan(in_front), "."));
    if (auto text = in_section(section, rest, names); !text.empty())
      return text;
  }
  return {};
}

std::string scenario_meaning(std::span<const std::string> path,
                             std::span<const std::string> names) {
  static const documented_options page{
      scenarios_page.substr(0, scenarios_page.find(maps_begin))};
  if (path.size() > 2 && path[0] == "policies" && path[1] != "forecast")
    return policy_meaning(path, names);
  if (path[0] == "lies" || path[0] == "hostile")
    return foul_meaning(path);
  auto text = page.of(path, names);
  // A provider has tables as the scenario has them.
  if (text.empty() && path.size() > 2 && path[0] == "provider")
    text = page.of(path.subspan(1), names);
  if (text.empty() && path.size() > 3 && path[1] == "provide")
    text = page.of(path.subspan(2), names);
  // Programs have a page of their own.
  static const documented_options programs{programs_page};
  for (const auto last : {2U, 1U})
    if (text.empty() && path.size() >= last)
      text = programs.of(path.last(last), names);
  return text;
}

std::string map_meaning(std::span<const std::string> path,
                        std::span<const std::string> names) {
  static const documented_options page{
      scenarios_page.substr(scenarios_page.find(maps_begin))};
  return page.of(path, names);
}

} // namespace sofof::experiments::schema
