// What is counted of a run: hours, episodes, faults.
#include "experiments/torture/check_ledger.hpp"
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace sofof::experiments::torture {

namespace {

/// Messages so far apart are not of one incident.
constexpr double apart_s = 0.5;
/// A session that is open for longer on one side is counted.
constexpr double late_limit_s = 2;

/// Counts incidents of one kind, vehicle by vehicle.
class incidents {
public:
  void add(std::uint64_t station, double t_s) {
    const auto [last, is_first] = last_.try_emplace(station, t_s);
    count_ += is_first || t_s - last->second > apart_s;
    last->second = t_s;
  }
  double count() const { return count_; }

private:
  std::map<std::uint64_t, double> last_;
  double count_ = 0;
};

/// Whether a vehicle at this provider, or at any, loses messages in bursts.
bool has_bursts(const scenario::scenario_definition& s,
                const std::string& provider) {
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    if (s.providers[k].name == provider)
      return s.channel_to(k)->burst_loss.mean_bad > duration{};
  return false;
}

void count_messages(const finished_run& run, tally& to) {
  incidents bursts, outages, stalls;
  for (const auto& cell : run.disturbed.cells) {
    const auto in_bursts = has_bursts(run.what, cell.provider);
    for (const auto& x : cell.disturbed) {
      const auto t_s = to_seconds(x.at);
      to[counted::slow] += static_cast<double>(x.count.slow);
      if (x.count.lost > 0 && in_bursts)
        bursts.add(x.station.value(), t_s);
      else
        to[counted::loss] += static_cast<double>(x.count.lost);
      if (x.count.outage > 0)
        outages.add(x.station.value(), t_s);
      if (x.count.stall > 0)
        stalls.add(x.station.value(), t_s);
    }
  }
  to[counted::burst] = bursts.count();
  to[counted::outage] = outages.count();
  to[counted::stall] = stalls.count();
}

void count_providers(const finished_run& run, tally& to) {
  const auto end = run.what.length;
  for (const auto& p : run.what.providers) {
    to[counted::crash] += p.fails_at && *p.fails_at < end;
    to[counted::reboot] += p.returns_at && *p.returns_at < end;
    for (const auto what : {"workers", "uplink", "downlink"})
      to[counted::full] +=
          2 * run.figure(fmt::format("load.{}.{}.full_s", p.name, what));
    if (p.has_no_map())
      for (const auto& x : run.episodes)
        to[counted::deaf_map] += !x.by_requester && x.of.provider == p.name;
  }
}

bool plans_by_al_ilqr(const scenario::scenario_definition& s) {
  const auto* planning = scenario::planning_service(s);
  return planning
         && scenario::to_toml(s).find("name = \"al_ilqr\"")
                != std::string::npos;
}

} // namespace

tally count(const finished_run& run) {
  tally all;
  const auto driven_s = run.figure("safety.driven_s");
  all[counted::driven_s] = driven_s;
  all[counted::al_ilqr_s] = plans_by_al_ilqr(run.what) ? driven_s : 0;
  all[counted::offloaded_s] = run.figure("offloaded_share") * driven_s;
  for (const auto& x : run.episodes)
    all[counted::episodes] += x.by_requester && x.first_data_s;
  const auto known = troubles_of(run);
  for (const auto& x : sessions_of(run))
    if (!x.requester.empty() && !x.provider.empty()) {
      ++all[counted::sessions];
      all[counted::late_2_s] += late_s(x, known) > late_limit_s;
    }
  count_messages(run, all);
  count_providers(run, all);
  for (const auto& type : run.what.services)
    all[counted::refusal] +=
        run.figure(fmt::format("services.{}.rejected", type->name()));
  return all;
}

} // namespace sofof::experiments::torture
