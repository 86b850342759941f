// Computing time of a run on the wall clock: what was measured, and the shares
// of a core that it means.
#include "recording/cpu_table.hpp"

#include "actors/runtime/cpu_clock.hpp"
#include "base/text/csv.hpp"

#include <cassert>
#include <set>

namespace sofof::recording {

namespace {

constexpr std::string_view header =
    "station,actor,service,source,cpu_s,time_s,percent,wakes\n";
constexpr std::string_view function = "service_instance";
constexpr std::string_view requester = "service_requester";

constexpr int places_of_percent = 6;

duration cost_of_a_look() {
  constexpr auto looks = 10'000;
  const auto began = actors::thread_cpu_time();
  for (auto k = 1; k < looks; ++k)
    actors::thread_cpu_time();
  return (actors::thread_cpu_time() - began) / looks;
}

struct sum {
  duration cpu{};
  duration time{};

  void add(const actors::cpu_line& line) {
    cpu += line.cpu;
    time += line.time;
  }
  std::optional<double> percent() const { return percent_of_core(cpu, time); }
};

void add_row(std::string& out, std::string_view actor, std::string_view service,
             std::string_view source, const sum& what, std::uint64_t wakes) {
  const auto field = [&out](const auto& x) {
    out += ',';
    append(out, x);
  };
  field(actor);
  field(service);
  field(source);
  field(seconds(what.cpu));
  field(seconds(what.time));
  field(rounded(what.percent(), places_of_percent));
  field(wakes);
  out += '\n';
}

} // namespace

std::uint64_t cpu_table::wakes() const {
  std::uint64_t all = 0;
  for (const auto& line : lines)
    all += line.wakes;
  return all;
}

cpu_meter::cpu_meter(actors::cpu_ledger& ledger, time_point now)
    : ledger_{&ledger}, look_{cost_of_a_look()}, began_{now},
      process_began_{actors::process_cpu_time()} {
  ledger.restart();
}

cpu_table cpu_meter::read(time_point now) const {
  return {ledger_->lines(), now - began_,
          actors::process_cpu_time() - process_began_, look_};
}

std::optional<double> percent_of_core(duration cpu, duration time) {
  if (time <= duration{})
    return std::nullopt;
  return 100 * to_seconds(cpu) / to_seconds(time);
}

std::optional<cpu_figures> figures_of(const cpu_table& table,
                                      std::string_view service) {
  sum active, inactive, sofof_local, sofof_remote;
  std::uint64_t wakes = 0;
  std::set<station_id> stations;
  for (const auto& line : table.lines) {
    const auto& [station, name, remote] = line.account;
    if (!station)
      continue;
    if (line.actor == function) {
      if (name.view() == service)
        (remote ? inactive : active).add(line);
      continue;
    }
    stations.insert(*station);
    wakes += line.wakes;
    auto& sofof = remote ? sofof_remote : sofof_local;
    sofof.cpu += line.cpu;
    if (line.actor == requester)
      sofof.time += line.time;
  }
  const auto a = active.percent(), d = inactive.percent();
  const auto local = sofof_local.percent(), far = sofof_remote.percent();
  if (!a || !d || !local || !far)
    return std::nullopt;
  const auto cpu = sofof_local.cpu + sofof_remote.cpu;
  const auto time = sofof_local.time + sofof_remote.time;
  const auto looking = table.look * static_cast<std::int64_t>(wakes);
  return cpu_figures{
      {*a, *d, *local, *far},    percent_of_core(cpu, time).value_or(0),
      stations.size(),           to_seconds(active.time),
      to_seconds(inactive.time), percent_of_core(looking, time).value_or(0)};
}

cpu_figures together(std::span<const cpu_figures> runs) {
  assert(!runs.empty());
  cpu_figures sum;
  sum.vehicles = runs.front().vehicles;
  for (const auto& x : runs) {
    assert(x.vehicles == sum.vehicles);
    const auto all_s = x.active_s + x.inactive_s;
    sum.shares.active += x.shares.active * x.active_s;
    sum.shares.requester += x.shares.requester * x.active_s;
    sum.shares.inactive += x.shares.inactive * x.inactive_s;
    sum.shares.requester_remote += x.shares.requester_remote * x.inactive_s;
    sum.requester_mean += x.requester_mean * all_s;
    sum.overhead += x.overhead * all_s;
    sum.active_s += x.active_s;
    sum.inactive_s += x.inactive_s;
  }
  const auto all_s = sum.active_s + sum.inactive_s;
  assert(sum.active_s > 0 && sum.inactive_s > 0);
  sum.shares.active /= sum.active_s;
  sum.shares.requester /= sum.active_s;
  sum.shares.inactive /= sum.inactive_s;
  sum.shares.requester_remote /= sum.inactive_s;
  sum.requester_mean /= all_s;
  sum.overhead /= all_s;
  return sum;
}

std::string to_csv(const cpu_table& table) {
  std::string out{header};
  for (const auto& line : table.lines) {
    const auto& [station, service, remote] = line.account;
    if (station)
      append(out, std::uint64_t{station->value()});
    add_row(out, line.actor, service.view(),
            !station ? ""
            : remote ? "remote"
                     : "local",
            {line.cpu, line.time}, line.wakes);
  }
  const auto wakes = table.wakes();
  const auto looking = 2 * table.look * static_cast<std::int64_t>(wakes);
  add_row(out, "(measuring)", "", "", {looking, table.length}, wakes);
  add_row(out, "(process)", "", "", {table.process_cpu, table.length}, wakes);
  return out;
}

} // namespace sofof::recording
