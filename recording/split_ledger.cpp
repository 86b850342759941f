// What was told of a time is shared among the splits of that time.
#include "recording/split_ledger.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>
#include <string_view>

namespace sofof::recording {

namespace {

/// Nothing is told of what is longer ago.
constexpr duration remembered = std::chrono::seconds{10};

/// @returns what of `all` comes after `before` and with `own` of a time in
/// which all of it is shared out; what is left of it in the end is nothing.
std::int64_t share_of(std::int64_t all, duration before, duration own,
                      duration together) {
  assert(together > duration{0});
  const auto until = [&](duration t) -> std::int64_t {
    if (t == together)
      return all;
    const auto share = to_seconds(t) / to_seconds(together);
    return std::llround(static_cast<double>(all) * share);
  };
  return until(before + own) - until(before);
}

std::uint64_t share_of(std::uint64_t all, duration before, duration own,
                       duration together) {
  return static_cast<std::uint64_t>(
      share_of(static_cast<std::int64_t>(all), before, own, together));
}

} // namespace

service_use& service_use::operator+=(const service_use& x) {
  computed += x.computed;
  computing += x.computing;
  octets_up += x.octets_up;
  octets_down += x.octets_down;
  results += x.results;
  for (const auto& [provider, time] : x.served)
    served[provider] += time;
  return *this;
}

split_ledger::split_ledger(const run_info& run)
    : start_{run.start}, names_{run.provider_names} {
  for (std::size_t c = 0; c < run.energy.chains.size(); ++c) {
    lengths_.push_back(run.energy.chains[c].size());
    for (std::size_t k = 0; k < run.energy.chains[c].size(); ++k)
      places_[run.energy.chains[c][k]] = {c, k};
  }
}

std::vector<split_ledger::stretch>&
split_ledger::stretches_of(const chain_user& who) {
  auto& all = stretches_[who];
  if (all.empty())
    all.push_back({start_, split(lengths_[who.chain])});
  return all;
}

split_use& split_ledger::use_of(const chain_user& who, const split& where) {
  auto& use = uses_[who][where];
  use.services.resize(lengths_[who.chain]);
  return use;
}

/// @returns the splits of a time, each with how much of it; at least one.
std::vector<split_ledger::part> split_ledger::parts_of(const chain_user& who,
                                                       const window& when) {
  auto& all = stretches_of(who);
  std::vector<part> parts;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto from = std::max(all[k].from, when.from);
    const auto until =
        k + 1 < all.size() ? std::min(all[k + 1].from, when.until) : when.until;
    if (from < until)
      parts.push_back({&use_of(who, all[k].where), until - from});
  }
  if (parts.empty()) // at one moment
    parts.push_back({&use_of(who, all.back().where), duration{1}});
  return parts;
}

void split_ledger::add(const messages::event_record& x) {
  if (x.what == messages::event_type::appeared)
    driven_[x.station] = {x.at, x.at};
  if (x.what != messages::event_type::switched)
    return;
  const auto found = places_.find(x.service.view());
  if (found == places_.end())
    return;
  const auto& [chain, service] = found->second;
  auto& all = stretches_of({x.station, chain});
  auto where = all.back().where;
  where[service] = x.remote ? std::string{name_of(x.provider, names_)} : "";
  all.push_back({std::max(x.at, all.back().from), std::move(where)});
  // The one that holds at the earliest time that is still told of stays.
  const auto old = std::ranges::find_if(
      all, [&](const stretch& s) { return s.from > x.at - remembered; });
  if (old - all.begin() > 1)
    all.erase(all.begin(), old - 1);
}

void split_ledger::add(const messages::work_record& x) {
  const auto found = places_.find(x.service.view());
  if (found == places_.end())
    return;
  const auto& [chain, service] = found->second;
  const auto parts = parts_of({x.station, chain}, {x.since, x.at});
  duration together{}, before{};
  for (const auto& p : parts)
    together += p.time;
  for (const auto& [of, time] : parts) {
    const auto mine = [&](auto all) {
      return share_of(all, before, time, together);
    };
    auto& use = of->services[service];
    use.computed += mine(x.computed);
    use.computing += duration{mine(std::int64_t{x.computing.count()})};
    use.octets_up += mine(x.octets_up);
    use.octets_down += mine(x.octets_down);
    before += time;
  }
}

void split_ledger::add(const messages::cycle_record& x) {
  const auto found = places_.find(x.session.service.view());
  if (found == places_.end())
    return;
  const chain_user who{x.session.station, found->second.chain};
  auto& use = use_of(who, stretches_of(who).back().where)
                  .services[found->second.service];
  ++use.results;
  use.served[std::string{name_of(x.session.provider, names_)}] +=
      x.timing.computing;
}

void split_ledger::add(const messages::safety_record& x) {
  auto& when =
      driven_.try_emplace(x.station, window{start_, start_}).first->second;
  when = {when.until, when.until + x.driven};
  if (x.driven > duration{0})
    for (std::size_t c = 0; c < lengths_.size(); ++c)
      for (const auto& [of, time] : parts_of({x.station, c}, when))
        of->driven += time;
}

/// It comes with that of how safely the same was driven, after it.
void split_ledger::add(const messages::drive_record& x) {
  const auto when = driven_.find(x.station);
  if (when == driven_.end() || x.ride.distance_m <= 0)
    return;
  const auto all_s = to_seconds(when->second.until - when->second.from);
  for (std::size_t c = 0; all_s > 0 && c < lengths_.size(); ++c)
    for (const auto& [of, time] : parts_of({x.station, c}, when->second))
      of->distance_m += x.ride.distance_m * to_seconds(time) / all_s;
}

} // namespace sofof::recording
