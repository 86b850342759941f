// Holds both sides to closing each session, once, and soon after each other.
#include "experiments/torture/check_ledger.hpp"

#include "base/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sofof::experiments::torture {

namespace {

using report::session_key;

/// What one side may take at most once the link carries again. The other side
/// says so again twice a second until it is confirmed, and each of ten messages
/// may be lost.
constexpr double longest_s = 5;
/// Of a session that a vehicle never knew, or never fed.
constexpr double longest_start_s = to_seconds(protocol::start_timeout) + 1;

/// A provider's second life has numbers of its own.
bool has_died(const finished_run& run, const session_key& of) {
  constexpr std::uint64_t next_life = 65536;
  if (of.provider_id >= next_life)
    return false;
  for (const auto& p : run.what.providers)
    if (p.name == of.provider)
      return p.fails_at && *p.fails_at < run.what.length;
  return false;
}

/// @returns how long a message may have waited for a full cell.
double longest_wait_s(const finished_run& run, const std::string& provider) {
  double sum_ms = 0;
  for (const auto way : {"uplink", "downlink"})
    sum_ms += run.figure(fmt::format("load.{}.{}.wait_ms.max", provider, way));
  return sum_ms / 1e3;
}

} // namespace

troubles troubles_of(const finished_run& run) {
  troubles all;
  for (const auto& cell : run.disturbed.cells)
    for (const auto& x : cell.disturbed)
      if (x.count.most() != channel::disturbance::none)
        all[{cell.provider, x.station.value()}].push_back(to_seconds(x.at));
  for (auto& [link, times] : all)
    std::ranges::sort(times);
  return all;
}

double calm_within(const std::vector<double>& troubled, double from_s,
                   double to_s) {
  double longest = 0, since = from_s;
  for (auto t = std::ranges::lower_bound(troubled, from_s);
       t != troubled.end() && *t < to_s; ++t) {
    longest = std::max(longest, *t - since);
    since = *t;
  }
  return std::max(longest, to_s - since);
}

std::vector<two_sides> sessions_of(const finished_run& run) {
  std::map<session_key, two_sides> all;
  for (const auto& line : run.episodes) {
    auto& sides = all[line.of];
    sides.of = line.of;
    (line.by_requester ? sides.requester : sides.provider).push_back(&line);
  }
  std::vector<two_sides> list;
  for (auto& [key, sides] : all)
    list.push_back(std::move(sides));
  return list;
}

double late_s(const finished_run& run, const two_sides& x,
              const troubles& known) {
  const auto a = x.requester.front()->ended_s, b = x.provider.front()->ended_s;
  const auto found = known.find({x.of.provider, x.of.station});
  static const std::vector<double> none;
  const auto calm_s = calm_within(found == known.end() ? none : found->second,
                                  std::min(a, b), std::max(a, b));
  return std::max(0.0, calm_s - longest_wait_s(run, x.of.provider));
}

void check_ledger(const finished_run& run, broken_promises& to) {
  const auto known = troubles_of(run);
  const auto end_s = to_seconds(run.what.length);
  for (const auto& x : sessions_of(run)) {
    const auto who = fmt::format("session {} of {} of station {} at {} ({})",
                                 x.of.counter, x.of.service, x.of.station,
                                 x.of.provider, x.of.provider_id);
    if (x.requester.size() > 1 || x.provider.size() > 1)
      to.push_back({"closed_once",
                    fmt::format("{} was closed {} times by the "
                                "vehicle and {} by the provider",
                                who, x.requester.size(), x.provider.size())});
    else if (x.provider.empty() && !has_died(run, x.of))
      to.push_back({"closed_by_both",
                    fmt::format("{}, which the vehicle closed at {:.3f} s, was "
                                "never closed by the provider",
                                who, x.requester.front()->ended_s)});
    else if (x.requester.empty()) {
      const auto& p = *x.provider.front();
      const auto died_s = dies_at_s(run.what, x.of.station);
      const auto since_s = std::max(p.accepted_s, died_s.value_or(0));
      if (p.ended_s < end_s && p.ended_s - since_s > longest_start_s)
        to.push_back(
            {"closed_by_both",
             fmt::format("{}, which the vehicle never closed, ran from {:.3f} "
                         "to {:.3f} s at the provider",
                         who, p.accepted_s, p.ended_s)});
    } else if (!x.provider.empty())
      if (const auto late = late_s(run, x, known); late > longest_s)
        to.push_back(
            {"closed_in_time",
             fmt::format("{} was closed at {:.3f} s by the vehicle and at "
                         "{:.3f} s by the provider, though the link carried, "
                         "and no message waited, for {:.3f} s in between",
                         who, x.requester.front()->ended_s,
                         x.provider.front()->ended_s, late)});
  }
}

} // namespace sofof::experiments::torture
