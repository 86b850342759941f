// Pooling runs, and putting entrants in order.
#include "experiments/benchmark/leaderboard.hpp"

#include "base/text/csv.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

namespace sofof::experiments::bench {

namespace {

constexpr int csv_places = 6;

using groups_by_seed = std::map<std::int64_t, study::group>;

std::optional<study::interval> interval_of(const groups_by_seed& by_seed) {
  std::vector<study::group> groups;
  for (const auto& [seed, group] : by_seed)
    groups.push_back(group);
  return study::mean_interval(groups);
}

std::optional<study::interval>
pooled(const std::vector<const judged_run*>& runs, std::string_view name) {
  groups_by_seed by_seed;
  for (const auto* run : runs) {
    auto& group = by_seed[run->seed];
    const auto found = run->values.find(name);
    if (found == run->values.end())
      continue;
    group.sum += found->second;
    ++group.count;
  }
  return interval_of(by_seed);
}

/// @returns whether nobody can tell by these runs which of two scores is less.
bool are_tied(const std::vector<const judged_run*>& one,
              const std::vector<const judged_run*>& other) {
  groups_by_seed by_seed;
  for (const auto* a : one)
    for (const auto* b : other)
      if (a->scenario == b->scenario && a->seed == b->seed) {
        auto& group = by_seed[a->seed];
        group.sum += b->values.at(score_name) - a->values.at(score_name);
        ++group.count;
      }
  const auto difference = interval_of(by_seed);
  return difference && difference->low <= 0 && difference->high >= 0;
}

standing standing_of(const std::string& entrant,
                     const std::vector<const judged_run*>& runs,
                     std::size_t expected) {
  standing one{entrant, runs.size(), 0, expected - runs.size(), {}};
  std::set<std::int64_t> seeds;
  for (const auto* run : runs) {
    one.unsafe += run->safe ? 0U : 1U;
    seeds.insert(run->seed);
  }
  one.seeds = seeds.size();
  for (const auto& by : criteria())
    if (const auto value = pooled(runs, by.name))
      one.values.emplace(by.name, *value);
  return one;
}

/// What standings are sorted by.
auto place_of(const standing& one) {
  const auto score = one.values.find(score_name);
  return std::tuple{!one.above_line(),
                    score != one.values.end()
                        ? score->second.mean
                        : std::numeric_limits<double>::infinity()};
}

std::size_t above_line(const std::vector<standing>& all) {
  return static_cast<std::size_t>(
      std::ranges::count_if(all, &standing::above_line));
}

struct standing_row {
  const leaderboard& board;
  const standing& one;
  std::uint64_t place; // counting from 1
  const entrant& who;
};

constexpr csv_column<standing_row> columns_of_standings[]{
    {"scenario",
     [](const auto& x) {
       return x.board.scenario.empty() ? "all"
                                       : std::string_view{x.board.scenario};
     }},
    {"place", [](const auto& x) { return x.place; }},
    {"entrant", [](const auto& x) { return std::string_view{x.who.name}; }},
    {"lodm", [](const auto& x) { return std::string_view{x.who.lodm}; }},
    {"codm", [](const auto& x) { return std::string_view{x.who.codm}; }},
    {"status",
     [](const auto& x) -> std::string_view {
       return x.one.above_line() ? "ranked" : "below the line";
     }},
    {"runs", [](const auto& x) { return x.one.runs; }},
    {"unsafe", [](const auto& x) { return x.one.unsafe; }},
    {"failed", [](const auto& x) { return x.one.failed; }},
    {"tied", [](const auto& x) { return x.one.tied; }},
};

/// Three columns for each criterion.
struct part_of_interval {
  std::string_view name_ends; // of the column
  double study::interval::*of;
};

constexpr part_of_interval parts_of_interval[]{
    {"", &study::interval::mean},
    {"_low", &study::interval::low},
    {"_high", &study::interval::high},
};

} // namespace

std::span<const standing> leaderboard::above() const {
  return std::span{standings}.first(above_line(standings));
}

std::span<const standing> leaderboard::below() const {
  return std::span{standings}.subspan(above_line(standings));
}

leaderboard rank(std::span<const judged_run> runs,
                 const expected_runs& expected, const std::string& scenario) {
  const auto each =
      expected.seeds * (scenario.empty() ? expected.scenarios.size() : 1);
  leaderboard all{scenario, {}};
  std::map<std::string, std::vector<const judged_run*>> runs_of;
  for (const auto& entrant : expected.entrants) {
    auto& own = runs_of[entrant];
    for (const auto& run : runs)
      if (run.entrant == entrant
          && (scenario.empty() || run.scenario == scenario))
        own.push_back(&run);
    all.standings.push_back(standing_of(entrant, own, each));
  }
  std::ranges::stable_sort(all.standings, {}, place_of);
  for (std::size_t i = 1; i < all.above().size(); ++i)
    all.standings[i].tied = are_tied(runs_of[all.standings[i - 1].entrant],
                                     runs_of[all.standings[i].entrant]);
  return all;
}

bool offloads(const standing& one) {
  constexpr double next_to_nothing = 1; // percent
  const auto share = one.values.find("offloaded_percent");
  return share == one.values.end() || share->second.mean >= next_to_nothing;
}

const study::interval* best_of(const leaderboard& all, const criterion& by) {
  if (by.wanted == better::neither)
    return nullptr;
  const auto sign = by.wanted == better::less ? 1 : -1;
  std::vector<const study::interval*> values;
  for (const auto& one : all.above())
    if (const auto found = one.values.find(by.name);
        found != one.values.end() && (by.name == score_name || offloads(one)))
      values.push_back(&found->second);
  const auto [best, worst] = std::ranges::minmax_element(
      values, {}, [sign](const auto* x) { return sign * x->mean; });
  if (values.empty() || (*best)->mean == (*worst)->mean)
    return nullptr;
  return *best;
}

std::string to_csv(std::span<const leaderboard> boards,
                   std::span<const entrant> entrants) {
  const csv_columns<standing_row> columns = columns_of_standings;
  std::string text;
  append_names(text, columns);
  for (const auto& by : criteria())
    for (const auto& [end, of] : parts_of_interval)
      ((text += ',') += by.name) += end;
  text += '\n';
  for (const auto& board : boards) {
    std::uint64_t place = 0;
    for (const auto& one : board.standings) {
      append_fields(
          text, columns,
          {board, one, ++place,
           *std::ranges::find(entrants, one.entrant, &entrant::name)});
      for (const auto& by : criteria()) {
        const auto found = one.values.find(by.name);
        const auto known = found != one.values.end();
        for (const auto& [end, of] : parts_of_interval) {
          text += ',';
          const auto tells = known && (end.empty() || one.seeds > 1);
          append(text, rounded(tells ? std::optional{found->second.*of}
                                     : std::nullopt,
                               csv_places));
        }
      }
      text += '\n';
    }
  }
  return text;
}

} // namespace sofof::experiments::bench
