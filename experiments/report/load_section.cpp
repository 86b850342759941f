// From load.csv and octets.csv.
#include "experiments/report/load_section.hpp"

#include "experiments/report/documented.hpp"
#include "recording/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::report {

namespace {

using runs_view = std::span<const recorded_run>;

constexpr std::array<std::string_view, 3> servers{"workers", "uplink",
                                                  "downlink"};

/// Of more providers pictures show those that were asked most.
constexpr std::size_t most_drawn = 12;

/// By the second.
struct load_curve {
  std::vector<double> t_s;
  std::vector<double> asked_percent;
  std::vector<double> mean_wait_ms, max_wait_ms; ///< NaN where no job came.
};

/// By provider and what of it.
using load_curves = std::map<std::pair<std::string, std::string>, load_curve>;

load_curves curves_of(const recorded_run& run) {
  constexpr auto none = std::numeric_limits<double>::quiet_NaN();
  load_curves all;
  for (const auto& line : read_load(run.folder)) {
    auto& to = all[{line.provider, line.what}];
    to.t_s.push_back(line.t_s);
    to.asked_percent.push_back(100 * line.asked_share);
    to.mean_wait_ms.push_back(line.mean_wait_ms.value_or(none));
    to.max_wait_ms.push_back(line.max_wait_ms.value_or(none));
  }
  return all;
}

/// @returns the providers of a run that pictures show.
std::set<std::string> drawn_of(const recorded_run& run,
                               const load_curves& loads) {
  std::map<std::string, double> asked;
  for (const auto& [of, load] : loads) {
    auto& most = asked[of.first];
    most = std::max(most, run.figure(fmt::format("load.{}.{}.asked_share",
                                                 of.first, of.second))
                              .value_or(0));
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, share] : asked)
    order.emplace_back(-share, name);
  std::ranges::sort(order);
  std::set<std::string> drawn;
  for (const auto& [share, name] :
       std::span{order}.first(std::min(most_drawn, order.size())))
    drawn.insert(name);
  return drawn;
}

/// Leaves out what pictures do not show, and says so.
void leave_drawn(section& to, runs_view runs, std::vector<load_curves>& loads) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto drawn = drawn_of(runs[i], loads[i]);
    std::set<std::string> all;
    for (const auto& [of, load] : loads[i])
      all.insert(of.first);
    if (drawn.size() == all.size())
      continue;
    std::erase_if(loads[i], [&drawn](const auto& one) {
      return !drawn.contains(one.first.first);
    });
    to.blocks.emplace_back(paragraph{fmt::format(
        "{}Pictures show the {} providers of {} that were asked most.",
        runs.size() == 1 ? "" : fmt::format("`{}`: ", runs[i].label),
        drawn.size(), all.size())});
  }
}

std::string label(const recorded_run& run, const std::string& provider,
                  runs_view runs) {
  return runs.size() == 1 ? provider
                          : fmt::format("{}: {}", run.label, provider);
}

/// One of the figures of load by time.
struct load_figure {
  struct shown_curve {
    std::string_view suffix; ///< Of its name.
    std::vector<double> load_curve::*y;
  };
  std::string_view title; ///< "{}" stands for what of a provider.
  std::string_view y_label;
  std::vector<shown_curve> curves;
  std::vector<std::pair<double, std::string>> levels{};
};

bool is_number(double y) {
  return !std::isnan(y);
}

/// Of workers, an uplink or a downlink, as far as any had work.
void add_figure(section& to, runs_view runs,
                const std::vector<load_curves>& loads, std::string_view what,
                const load_figure& of_load) {
  figure shown;
  shown.title = fmt::format(fmt::runtime(of_load.title),
                            what == "workers" ? std::string{what}
                                              : fmt::format("the {}", what));
  shown.x_label = "time, s";
  shown.y_label = of_load.y_label;
  shown.levels = of_load.levels;
  shown.by_clock = true;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const auto& [of, load] : loads[i])
      if (of.second == what)
        for (const auto& [suffix, y] : of_load.curves)
          if (std::ranges::any_of(load.*y, is_number))
            shown.curves.push_back(
                {.name = label(runs[i], of.first, runs).append(suffix),
                 .x = load.t_s,
                 .y = load.*y,
                 .low = {},
                 .high = {},
                 .provider = runs.size() == 1 ? runs[i].place_of(of.first)
                                              : std::nullopt});
  if (!shown.curves.empty())
    to.blocks.emplace_back(std::move(shown));
}

void add_curves(section& to, runs_view runs,
                const std::vector<load_curves>& loads) {
  const load_figure asked{"Asked of {} by time",
                          "asked for, %",
                          {{"", &load_curve::asked_percent}},
                          {{100, "all that they can do"}}};
  const load_figure waits{"Waits for {} by time",
                          "wait, ms",
                          {{", mean", &load_curve::mean_wait_ms},
                           {", longest", &load_curve::max_wait_ms}}};
  for (const auto what : servers)
    for (const auto* of_load : {&asked, &waits})
      add_figure(to, runs, loads, what, *of_load);
}

/// A column of the table, and the figure of the summary that it shows.
struct load_column {
  std::string_view title;
  std::string_view name;
  int decimals;
  double scale;
};

constexpr load_column load_columns[]{
    {"busy, %", "busy_share", 1, 100},
    {"asked for, %", "asked_share", 1, 100},
    {"at most, in half a second, %", "peak_share", 1, 100},
    {"full for, s", "full_s", 1, 1},
    {"wait, mean, ms", "wait_ms.mean", 2, 1},
    {"wait, 99 %, ms", "wait_ms.p99", 2, 1},
    {"wait, longest, ms", "wait_ms.max", 2, 1},
};

table servers_of(runs_view runs, const std::vector<load_curves>& loads) {
  table all;
  all.columns = {"provider", "what"};
  all.column_meanings = {documented("load.csv", "provider"),
                         documented("load.csv", "what")};
  for (const auto& column : load_columns) {
    all.columns.emplace_back(column.title);
    all.column_meanings.push_back(documented(
        "summary.json", fmt::format("load.any.workers.{}", column.name)));
  }
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const auto& [of, load] : loads[i]) {
      auto& row = all.rows.emplace_back();
      row = {label(runs[i], of.first, runs), of.second};
      for (const auto& column : load_columns) {
        const auto value = runs[i].figure(
            fmt::format("load.{}.{}.{}", of.first, of.second, column.name));
        row.push_back(value ? fmt::format("{:.{}f}", column.scale * *value,
                                          column.decimals)
                            : "");
      }
    }
  return all;
}

/// A run that is missing in the table would look forgotten.
void name_without_load(section& to, runs_view runs,
                       const std::vector<load_curves>& loads) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (loads[i].empty())
      to.blocks.emplace_back(paragraph{fmt::format(
          "`{}`: {}", runs[i].label,
          std::filesystem::exists(runs[i].folder / "load.csv")
              ? "nothing could be full, as no computing and no airtime took "
                "time."
              : "load was not recorded.")});
}

/// By direction and purpose.
using octets_of_cell =
    std::map<std::pair<std::string, std::string>, std::vector<octets_line>>;

/// By provider.
std::map<std::string, octets_of_cell> octets_by_cell(const recorded_run& run) {
  std::map<std::string, octets_of_cell> all;
  for (auto& x : read_octets(run.folder)) {
    auto& lines = all[x.provider][{x.direction, x.what}];
    lines.push_back(std::move(x));
  }
  return all;
}

/// Where there is no line of `each_s`, nothing was sent.
void add_silence(curve& to, double next_s, double each_s) {
  if (to.x.empty() || to.x.back() + each_s >= next_s)
    return;
  for (const auto t_s : {to.x.back() + each_s, next_s - each_s})
    if (t_s > to.x.back()) {
      to.x.push_back(t_s);
      to.y.push_back(0);
    }
}

/// One figure for each provider, of all that was sent to it and by it.
/// @param loads  Of the providers that pictures show; none where no load was
///               recorded.
void add_octets_by_time(section& to, const recorded_run& run,
                        const load_curves& loads) {
  constexpr double kilobits = 8e-3;
  const auto each_s =
      recording::seconds_of_line(run.figure("virtual_s").value_or(0));
  const auto drawn = drawn_of(run, loads);
  for (const auto& [provider, cell] : octets_by_cell(run)) {
    if (!drawn.empty() && !drawn.contains(provider))
      continue;
    figure shown;
    shown.title = fmt::format("On the air of {} by time", provider);
    shown.x_label = "time, s";
    shown.y_label = "sent, kbit/s";
    shown.by_clock = true;
    for (const auto& [of, lines] : cell) {
      auto& curve = shown.curves.emplace_back();
      curve.name = fmt::format("{} {}", of.second, of.first);
      for (const auto& x : lines) {
        if (!x.t_s)
          continue;
        add_silence(curve, *x.t_s, each_s);
        curve.x.push_back(*x.t_s);
        curve.y.push_back(kilobits * static_cast<double>(x.sent) / each_s);
      }
    }
    if (std::ranges::any_of(shown.curves,
                            [](const auto& c) { return !c.x.empty(); }))
      to.blocks.emplace_back(std::move(shown));
  }
}

table octets_of(runs_view runs) {
  static constexpr std::string_view names[]{
      "provider", "direction", "what", "messages",
      "sent",     "delivered", "lost", "under_way"};
  table all;
  all.title = "Octets on the air";
  for (const auto name : names) {
    all.columns.emplace_back(name == "under_way" ? "under way" : name);
    all.column_meanings.push_back(documented("octets.csv", name));
  }
  for (const auto& run : runs)
    for (const auto& [provider, cell] : octets_by_cell(run))
      for (const auto& [of, lines] : cell) {
        auto& row = all.rows.emplace_back();
        row = {label(run, provider, runs), of.first, of.second};
        for (const auto count : {&octets_line::messages, &octets_line::sent,
                                 &octets_line::delivered, &octets_line::lost,
                                 &octets_line::under_way}) {
          std::uint64_t sum = 0;
          for (const auto& x : lines)
            sum += x.*count;
          row.push_back(std::to_string(sum));
        }
      }
  return all;
}

} // namespace

section load_section(runs_view runs) {
  section all{.title = "Load", .blocks = {}};
  std::vector<load_curves> loads;
  for (const auto& run : runs)
    loads.push_back(curves_of(run));
  if (auto one = servers_of(runs, loads); !one.rows.empty()) {
    all.blocks.emplace_back(std::move(one));
    name_without_load(all, runs, loads);
  }
  leave_drawn(all, runs, loads);
  add_curves(all, runs, loads);
  if (auto one = octets_of(runs); !one.rows.empty()) {
    all.blocks.emplace_back(std::move(one));
    if (runs.size() == 1)
      add_octets_by_time(all, runs.front(), loads.front());
  }
  return all;
}

} // namespace sofof::experiments::report
