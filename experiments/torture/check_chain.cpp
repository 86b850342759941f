// Holds the services of a chain to going on.
#include "base/text/csv_reader.hpp"
#include "experiments/conformance/trace_file.hpp"
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::experiments::torture {

namespace {

/// For the next input to come, and for the own function, on a slow computer.
constexpr double own_turn_s = 0.5;

/// @returns how long a service of a chain may use no result: as long as its
/// provider may be silent, after those before it have been.
double longest_gap_s(const scenario::scenario_definition& s,
                     const actors::service_type& type) {
  const auto* before = scenario::find_service(s, type.follows());
  return (before ? longest_gap_s(s, *before) : 0)
         + to_seconds(type.options.limits.max_interarrival) + own_turn_s;
}

using gaps = std::map<std::string, double, std::less<>>;

/// @returns that of each service of the chain; empty: there is none.
gaps longest_gaps_s(const scenario::scenario_definition& s) {
  gaps all;
  for (const auto& type : s.services)
    if (const auto* before = scenario::find_service(s, type->follows())) {
      all[std::string{type->name()}] = longest_gap_s(s, *type);
      all[std::string{before->name()}] = longest_gap_s(s, *before);
    }
  return all;
}

/// When a service of a vehicle has used a result, as far as that counts.
struct used_results {
  double last_s = 0;
  double longest_gap_s = 0, after_s = 0;

  void add(double t_s) {
    if (t_s - last_s > longest_gap_s) {
      longest_gap_s = t_s - last_s;
      after_s = last_s;
    }
    last_s = t_s;
  }
};

} // namespace

void check_chain(const finished_run& run, broken_promises& to) {
  const auto longest_s = longest_gaps_s(run.what);
  if (longest_s.empty())
    return;
  static constexpr std::array<std::string_view, 5> columns{
      "t_s", "by", "what", "station", "services"};
  csv_reader rows{conformance::trace_file_of(run.folder), columns};
  std::map<std::uint64_t, double> last_s; // step of any selector
  std::map<std::pair<std::uint64_t, std::string>, used_results> all;
  while (rows.next()) {
    if (rows.text(1) != "selector")
      continue;
    const auto t_s = rows.number(0);
    const auto station = rows.whole(3);
    if (last_s.insert_or_assign(station, t_s).second)
      for (const auto& [service, longest] : longest_s) // one may never give any
        all.try_emplace({station, service}, used_results{t_s});
    auto service = rows.text(4).substr(0, rows.text(4).find('#'));
    if (rows.text(2) != "used" || !longest_s.contains(service))
      continue;
    all.at({station, std::move(service)}).add(t_s);
  }
  for (auto& [of, used] : all) {
    used.add(last_s.at(of.first));
    if (used.longest_gap_s > longest_s.at(of.second))
      to.push_back({"chain_goes_on",
                    fmt::format("{} of station {} used no result for {:.3f} s "
                                "after {:.3f} s, though its limits admit "
                                "{:.3f} s",
                                of.second, of.first, used.longest_gap_s,
                                used.after_s, longest_s.at(of.second))});
  }
}

} // namespace sofof::experiments::torture
