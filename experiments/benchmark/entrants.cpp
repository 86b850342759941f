// From policies and lines of a file to entrants.
#include "experiments/benchmark/entrants.hpp"

#include "base/input_error.hpp"
#include "base/options/option_printer.hpp"
#include "base/options/spelling.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_nodes.hpp"
#include "base/options/toml_options.hpp"
#include "base/options/toml_text.hpp"
#include "policies/registry.hpp"
#include "scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::experiments::bench {

namespace {

constexpr std::string_view everybody = "all";
constexpr std::string_view beside = "location";

// What others are compared with: vehicles that know what links will do, at
// providers that find the best assignment.
constexpr std::string_view best_possible = "oracle";
constexpr std::string_view best_shared_out = "assignment";

std::vector<std::string_view> names_of(const std::vector<entrant>& all) {
  std::vector<std::string_view> names;
  for (const auto& one : all)
    names.push_back(one.name);
  return names;
}

bool is_among(std::string_view name, const std::vector<entrant>& all) {
  return std::ranges::find(all, name, &entrant::name) != all.end();
}

/// @param name  Its own, or that of a policy behind its side: "codm:edf".
const entrant& find_entrant(const std::vector<entrant>& all,
                            std::string_view name) {
  const auto plain = name.substr(name.find(':') + 1);
  auto found = std::ranges::find(all, name, &entrant::name);
  if (found == all.end())
    found = std::ranges::find_if(all, [&](const entrant& x) {
      return x.name == plain
             && ((name.starts_with("lodm:") && x.lodm == plain)
                 || (name.starts_with("codm:") && x.codm == plain));
    });
  if (found == all.end())
    throw input_error{unknown_word("entrant", name, names_of(all))};
  return *found;
}

/// Has the paths of a policy's options lead to the same places wherever the
/// scenario is.
/// @param folder  Of the file that they stand in.
void anchor(toml::table& policies, std::string_view side,
            const std::filesystem::path& folder) {
  auto* table = policies[side].as_table();
  if (!table)
    return;
  const auto name = (*table)["name"].value_or(std::string{});
  const auto place = [&](std::string_view key) {
    const auto given = (*table)[key].value_or(std::string{});
    const auto there = std::filesystem::absolute("." / folder / given) / "";
    table->insert_or_assign(key,
                            there.lexically_normal().parent_path().string());
  };
  if (const auto lodm = policies::make_lodm(name);
      side == "lodm" && lodm && lodm->learned_from()
      && table->contains("snapshot"))
    place("snapshot");
  if (name == "process")
    place("folder");
}

std::string text_of(const toml::table& policies, std::string_view side) {
  const auto* node = policies.get(side);
  if (!node)
    return std::string{beside};
  return node->value<std::string>().value_or(value_text(*node));
}

/// @returns whether nobody would take it for something else.
bool is_name(std::string_view name) {
  return !name.empty() && name.find_first_of(",\"\n\r\t") == name.npos
         && !name.starts_with(' ') && !name.ends_with(' ') && name != everybody;
}

void check_name(std::string_view name, const std::string& place) {
  if (!is_name(name) && name != everybody)
    throw input_error{fmt::format("{}: {} is no name for an entrant; it must "
                                  "be a word without commas and quotes.",
                                  place, quoted_toml(name))};
  if (name == everybody)
    throw input_error{fmt::format("{}: \"{}\" means all of them; choose "
                                  "another name.",
                                  place, everybody)};
}

/// Reads them as a scenario would, and finds mistakes where they stand.
scenario::policy_options read_policies(toml::node& line,
                                       std::string_view file) {
  scenario::policy_options policies;
  std::vector<option_note> notes; // no option of policies has moved
  toml_options reader{line, file, notes};
  policies.visit_options(reader);
  reader.finish();
  return policies;
}

/// @returns whether they are those of a scenario that says nothing.
bool are_usual(scenario::policy_options policies) {
  scenario::policy_options usual;
  const auto text = [](scenario::policy_options& x) {
    return print_options([&x](option_visitor& s) { x.visit_options(s); });
  };
  return text(policies) == text(usual);
}

} // namespace

sweep_axis::value entrant::as_value() const {
  return {name, {"policies.lodm=" + lodm, "policies.codm=" + codm}};
}

std::vector<entrant> plain_entrants() {
  std::vector<entrant> all;
  for (const auto name : policies::lodm_names()) {
    if (policies::make_lodm(name)->program())
      continue; // which one?
    const auto codm = name == best_possible ? best_shared_out : beside;
    all.push_back({std::string{name}, std::string{name}, std::string{codm}});
  }
  for (const auto name : policies::codm_names()) {
    if (name == beside) // with itself: there already
      continue;
    if (policies::make_codm(name)->program())
      continue;
    const auto taken = is_among(name, all);
    all.push_back({fmt::format("{}{}", taken ? "codm:" : "", name),
                   std::string{beside}, std::string{name}});
  }
  return all;
}

std::vector<entrant> parse_entrants(std::string_view text,
                                    const std::string& file) {
  auto root = parse_toml(text, file);
  const auto plain = plain_entrants();
  std::vector<entrant> all;
  for (auto&& [key, line] : root) {
    const auto place = place_of(line.source(), file);
    check_name(key.str(), place);
    if (is_among(key.str(), plain))
      throw input_error{fmt::format("{}: there is an entrant \"{}\" already, "
                                    "the policy with its defaults; choose "
                                    "another name.",
                                    place, key.str())};
    if (!line.is_table())
      throw input_error{fmt::format(
          "{}: an entrant is a table, {{ lodm = POLICY, codm = POLICY }}.",
          place)};
    read_policies(line, file);
    auto& policies = *line.as_table();
    for (const auto* side : {"lodm", "codm"})
      anchor(policies, side, std::filesystem::path{file}.parent_path());
    all.push_back({std::string{key.str()}, text_of(policies, "lodm"),
                   text_of(policies, "codm")});
  }
  return all;
}

std::vector<entrant> load_entrants(const std::filesystem::path& file) {
  return parse_entrants(require_text(file), file.string());
}

std::optional<entrant> own_entrant(const std::filesystem::path& scenario) {
  const auto text = read_text(scenario);
  const auto name = scenario.filename().string();
  if (!text || !is_name(name))
    return std::nullopt; // who loads it says what is wrong
  auto root = parse_toml(*text, scenario.string());
  auto* policies = root["policies"].as_table();
  if (!policies || are_usual(read_policies(*policies, scenario.string())))
    return std::nullopt;
  for (const auto* side : {"lodm", "codm"})
    anchor(*policies, side, scenario.parent_path());
  return entrant{name, text_of(*policies, "lodm"), text_of(*policies, "codm")};
}

void add_own_entrants(std::vector<entrant>& to,
                      const std::vector<std::string>& scenarios) {
  for (const auto& scenario : scenarios)
    if (auto own = own_entrant(scenario)) {
      if (is_among(own->name, to))
        throw input_error{fmt::format("{}: there is an entrant \"{}\" already; "
                                      "rename one of them.",
                                      scenario, own->name)};
      to.push_back(*std::move(own));
    }
}

std::vector<entrant> chosen_from(const std::vector<entrant>& all,
                                 std::string_view wanted) {
  if (wanted == everybody)
    return all;
  std::vector<entrant> chosen;
  for (std::size_t at = 0; at <= wanted.size();) {
    const auto comma = std::min(wanted.find(',', at), wanted.size());
    const auto name = wanted.substr(at, comma - at);
    if (name == everybody)
      throw input_error{fmt::format("\"{}\" has everybody in it; let it stand "
                                    "alone.",
                                    everybody)};
    const auto& found = find_entrant(all, name);
    if (is_among(found.name, chosen))
      throw input_error{
          fmt::format("the entrant \"{}\" stands there twice.", found.name)};
    chosen.push_back(found);
    at = comma + 1;
  }
  return chosen;
}

} // namespace sofof::experiments::bench
