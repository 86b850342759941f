// What is counted of a run: hours, episodes, faults.
#include "experiments/torture/check_ledger.hpp"
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

namespace {

/// Messages so far apart are not of one incident.
constexpr double apart_s = 0.5;
/// A session that is open for longer on one side is counted.
constexpr double late_limit_s = 2;

/// Counts incidents of one kind, vehicle by vehicle: what one provider's link
/// or one direction of it met is the same incident as what another one did.
class incidents {
public:
  void add(std::uint64_t station, double t_s) {
    times_[station].push_back(t_s);
  }
  double count() {
    double count = 0;
    for (auto& [station, times] : times_) {
      std::ranges::sort(times);
      for (std::size_t k = 0; k < times.size(); ++k)
        count += k == 0 || times[k] - times[k - 1] > apart_s;
    }
    return count;
  }

private:
  std::map<std::uint64_t, std::vector<double>> times_;
};

/// Whether what was lost at a time was lost in one direction only.
bool is_one_way(const std::vector<channel::outage_options>& outages,
                duration at) {
  return std::ranges::none_of(outages, [at](const auto& x) {
    return x.direction == "both" && x.from <= at && at < x.to;
  });
}

void count_messages(const finished_run& run, tally& to) {
  incidents bursts, outages, one_way, stalls;
  for (const auto& cell : run.disturbed.cells) {
    const auto& channel = channel_to(run.what, cell.provider);
    const auto in_bursts = channel.burst_loss.mean_bad > duration{};
    for (const auto& x : cell.disturbed) {
      const auto t_s = to_seconds(x.at);
      to[counted::slow] += static_cast<double>(x.count.slow);
      to[counted::copied] += static_cast<double>(x.count.copied);
      to[counted::overtaken] += static_cast<double>(x.count.overtaken);
      if (x.count.lost > 0 && in_bursts)
        bursts.add(x.station.value(), t_s);
      else
        to[counted::loss] += static_cast<double>(x.count.lost);
      if (x.count.outage > 0)
        (is_one_way(channel.outages, x.at) ? one_way : outages)
            .add(x.station.value(), t_s);
      if (x.count.stall > 0)
        stalls.add(x.station.value(), t_s);
    }
  }
  to[counted::burst] = bursts.count();
  to[counted::outage] = outages.count();
  to[counted::one_way] = one_way.count();
  to[counted::stall] = stalls.count();
}

// Of those that had a session before.
void count_vehicles(const finished_run& run, tally& to) {
  std::map<std::uint64_t, double> first_s;
  for (const auto& x : run.episodes)
    if (const auto [known, is_first] =
            first_s.try_emplace(x.of.station, x.accepted_s);
        !is_first)
      known->second = std::min(known->second, x.accepted_s);
  for (const auto& [station, since_s] : first_s)
    if (const auto died_s = dies_at_s(run.what, station))
      to[counted::dead_car] += since_s < *died_s;
}

void count_providers(const finished_run& run, tally& to) {
  const auto end = run.what.length;
  for (const auto& p : run.what.providers) {
    const auto had_session = [&](const report::episode_line& x) {
      return x.of.provider == p.name && p.fails_at
             && x.accepted_s < to_seconds(*p.fails_at);
    };
    if (p.fails_at && *p.fails_at < end
        && std::ranges::any_of(run.episodes, had_session)) {
      ++to[counted::crash];
      to[counted::reboot] += p.returns_at && *p.returns_at < end;
    }
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
  if (scenario::find_service(run.what, "tracking")) {
    const auto at_provider_s = [&](std::string_view service) {
      return run.figure(fmt::format("services.{}.offloaded_share", service))
             * driven_s;
    };
    all[counted::chain_s] = driven_s;
    all[counted::tracking_s] = at_provider_s("tracking");
    all[counted::environment_s] = at_provider_s("environment_model");
  }
  for (const auto& x : run.episodes)
    all[counted::episodes] += x.by_requester && x.first_data_s;
  const auto known = troubles_of(run);
  for (const auto& x : sessions_of(run))
    if (!x.requester.empty() && !x.provider.empty()) {
      ++all[counted::sessions];
      all[counted::late_2_s] += late_s(run, x, known) > late_limit_s;
    }
  count_messages(run, all);
  for (const auto& e : run.events)
    if (e.what == "implausible" && run.has_liars)
      ++all[counted::lie];
    else if (e.what == "implausible" && !run.has_ghosts)
      ++all[counted::disbelieved];
  count_vehicles(run, all);
  count_providers(run, all);
  for (const auto& type : run.what.services)
    all[counted::refusal] +=
        run.figure(fmt::format("services.{}.rejected", type->name()));
  return all;
}

} // namespace sofof::experiments::torture
