// From the events that were to lead to an episode.
#include "experiments/explain/absence.hpp"

#include "base/input_error.hpp"
#include "base/reason.hpp"
#include "base/text/csv_reader.hpp"
#include "base/text/words.hpp"
#include "base/text/wrapped.hpp"
#include "recording/headline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace sofof::experiments::explain {

namespace {

namespace fs = std::filesystem;

/// Vehicles that drove, as far as the folder tells.
std::set<std::uint64_t>
stations_in(const fs::path& folder,
            const std::vector<report::event_line>& all) {
  std::set<std::uint64_t> found;
  for (const auto& x : all)
    found.insert(x.of.station);
  const auto file = folder / "vehicles.csv";
  if (!fs::exists(file))
    return found;
  static constexpr std::string_view names[]{"station"};
  csv_reader row{file, names};
  while (row.next())
    found.insert(row.whole(0));
  return found;
}

void refuse_unknown(const fs::path& folder, const question& q,
                    const std::vector<report::event_line>& events,
                    const std::optional<report::run_summary>& summary) {
  const auto refuse = [&folder](const std::string& what,
                                std::string_view file) {
    throw input_error{fmt::format("{}: this run has no {}; {} names all.",
                                  folder.string(), what, file)};
  };
  if (q.station && !stations_in(folder, events).contains(*q.station))
    refuse(fmt::format("station {}", *q.station), "vehicles.csv");
  const auto is_known =
      q.service.empty()
      || std::ranges::any_of(
          events, [&q](const auto& x) { return x.of.service == q.service; })
      || (summary
          && summary->figures.contains(
              fmt::format("services.{}.requests", q.service)));
  if (!is_known)
    refuse(fmt::format("service {}", q.service), "summary.json");
}

/// @param names_services  Whether offers of the run tell of what they are.
bool offers(const report::event_line& x, const question& q,
            bool names_services) {
  if (!names_services)
    return true;
  return q.service.empty() ? !x.detail.empty() : has_word(x.detail, q.service);
}

/// @returns what came before an episode could begin.
recording::service_metrics
count_attempts(const std::vector<report::event_line>& events,
               const question& q) {
  // Offers of older versions do not.
  const auto names_services = std::ranges::any_of(events, [](const auto& x) {
    return x.what == "offer" && !x.detail.empty();
  });
  recording::service_metrics all;
  for (const auto& x : events) {
    if (q.station && x.of.station != *q.station)
      continue;
    if (x.what == "offer" && offers(x, q, names_services))
      ++all.offers;
    if (!q.is_about(x.of))
      continue;
    if (x.what == "accepted")
      ++all.accepted;
    if (x.what == "refused") {
      ++all.rejected;
      ++all.refused[std::string{reason::words_of(x.detail)}];
    }
    if (x.what == "stay_local")
      ++all.stayed[std::string{reason::words_of(x.detail)}];
  }
  return all;
}

void refuse_time_outside(const fs::path& folder, double at_s,
                         const std::vector<report::event_line>& events) {
  if (at_s < 0)
    throw input_error{fmt::format("--at {:g}: a run begins at 0 s.", at_s)};
  const auto summary = report::read_summary(folder);
  const auto length = summary ? summary->figures.find("virtual_s")
                              : decltype(summary->figures.end()){};
  // A run that was killed went on until its last event, at least.
  auto ended_s = events.empty() ? 0 : events.back().t_s;
  if (summary && length != summary->figures.end())
    ended_s = length->second;
  if (at_s > ended_s)
    throw input_error{fmt::format("--at {:g}: the run in {} ended at {:g} s.",
                                  at_s, folder.string(), ended_s)};
}

} // namespace

std::string tell_moment(const fs::path& folder, const question& q) {
  constexpr double near_s = 1;
  const auto at_s = q.at_s.value();
  const auto events = report::read_events(folder);
  refuse_time_outside(folder, at_s, events);
  const auto far_s = [at_s](const report::event_line& x) {
    return std::abs(x.t_s - at_s);
  };
  const report::event_line* nearest = nullptr;
  for (const auto& x : events)
    if ((x.what == "refused" || x.what == "stay_local") && q.is_about(x.of)
        && far_s(x) <= near_s && (!nearest || far_s(x) < far_s(*nearest)))
      nearest = &x;
  auto text = fmt::format("No episode ran at {:g} s", at_s);
  if (!nearest)
    return text;
  const auto& of = nearest->of;
  return text
         + fmt::format("; at {:.3f} s {} of station {} {}{}{}", nearest->t_s,
                       of.service, of.station,
                       nearest->what == "refused"
                           ? fmt::format("was refused by {}", of.provider)
                           : "stayed in the vehicle",
                       nearest->detail.empty() ? "" : ": ", nearest->detail);
}

std::string tell_absence(const fs::path& folder, const question& q) {
  constexpr std::size_t line_width = 80;
  const auto summary = report::read_summary(folder);
  const auto events = report::read_events(folder);
  if (std::ranges::any_of(report::read_episodes(folder),
                          [&q](const auto& x) { return q.is_about(x.of); }))
    throw input_error{fmt::format("{}: only a provider has closed such "
                                  "episodes; name the results of the vehicles "
                                  "(`sofof drive`).",
                                  folder.string())};
  refuse_unknown(folder, q, events, summary);
  std::string text;
  if (q.at_s)
    text = wrapped(tell_moment(folder, q) + '.', line_width) + '\n';
  else if (summary)
    for (const auto& sentence : summary->headline)
      text += wrapped(sentence, line_width) + '\n';
  if (summary && !q.station && q.service.empty())
    return text;
  const auto all = count_attempts(events, q);
  std::string whose;
  if (q.station)
    whose += fmt::format("Station {}", *q.station);
  if (!q.service.empty())
    whose += fmt::format("{}{}", whose.empty() ? "" : ", ", q.service);
  if (!whose.empty())
    whose += ": ";
  const auto why = all.accepted > 0
                       ? "accepted, but no vehicle has closed an episode yet."
                       : recording::why_never(all);
  return text
         + wrapped(fmt::format("{}never offloaded: {}", whose, why), line_width)
         + '\n';
}

} // namespace sofof::experiments::explain
