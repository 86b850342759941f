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

/// What one side may take at most of the time in which the link carries. The
/// other side says so again twice a second until it is confirmed, and each of
/// ten messages may be lost.
constexpr double longest_s = 5;
/// Of a session that a vehicle never knew, or never fed.
constexpr double longest_start_s = to_seconds(protocol::start_timeout) + 1;
/// A vehicle sends something so often at least: a CAM.
constexpr double silence_s = 1;

/// A provider's second life has numbers of its own.
/// @returns when the life ended, if it did, in which it had this session.
std::optional<double> died_s(const finished_run& run, const session_key& of) {
  constexpr std::uint64_t next_life = 65536;
  for (const auto& p : run.what.providers)
    if (p.name == of.provider && of.provider_id < next_life && p.fails_at
        && *p.fails_at < run.what.length)
      return to_seconds(*p.fails_at);
  return std::nullopt;
}

/// @returns how long a message may have waited for a full cell between these.
double longest_wait_s(const finished_run& run, const std::string& provider,
                      double from_s, double to_s) {
  std::map<std::string, double> most_ms; // of each direction
  for (const auto& x : run.load)
    if (x.provider == provider && x.what != "workers" && x.max_wait_ms
        && x.t_s < to_s && from_s < x.t_s + 1)
      most_ms[x.what] = std::max(most_ms[x.what], *x.max_wait_ms);
  double sum_ms = 0;
  for (const auto& [direction, ms] : most_ms)
    sum_ms += ms;
  return sum_ms / 1e3;
}

/// @returns for how long the link carried between these, and nothing waited.
double carried_s(const finished_run& run, const session_key& of,
                 const troubles& known, double from_s, double to_s) {
  static const std::vector<time_span> none;
  const auto found = known.find({of.provider, of.station});
  const auto calm_s =
      calm_within(found == known.end() ? none : found->second, from_s, to_s);
  return std::max(0.0, calm_s - longest_wait_s(run, of.provider, from_s, to_s));
}

} // namespace

const channel::channel_profile&
channel_to(const scenario::scenario_definition& s,
           const std::string& provider) {
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    if (s.providers[k].name == provider)
      return *s.channel_to(k);
  return *s.network.channel;
}

troubles troubles_of(const finished_run& run) {
  std::map<std::pair<std::string, std::uint64_t>, std::vector<double>> moments;
  for (const auto& cell : run.disturbed.cells) {
    const auto in_bursts =
        channel_to(run.what, cell.provider).burst_loss.mean_bad > duration{};
    for (const auto& x : cell.disturbed)
      if (x.count.outage > 0 || x.count.stall > 0
          || (x.count.lost > 0 && in_bursts))
        moments[{cell.provider, x.station.value()}].push_back(to_seconds(x.at));
  }
  troubles all;
  for (auto& [link, times] : moments) {
    std::ranges::sort(times);
    auto& spans = all[link];
    for (const auto t : times)
      if (!spans.empty() && t <= spans.back().to_s)
        spans.back().to_s = t + silence_s;
      else
        spans.push_back({t, t + silence_s});
  }
  return all;
}

double calm_within(const std::vector<time_span>& troubled, double from_s,
                   double to_s) {
  auto calm_s = to_s - from_s;
  for (const auto& x : troubled)
    calm_s -=
        std::max(0.0, std::min(to_s, x.to_s) - std::max(from_s, x.from_s));
  return calm_s;
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
  const auto [first, last] =
      std::minmax(x.requester.front()->ended_s, x.provider.front()->ended_s);
  return carried_s(run, x.of, known, first, last);
}

namespace {

/// A provider may die before it has heard that it should close a session.
bool has_heard(const finished_run& run, const two_sides& x,
               const troubles& known) {
  const auto until_s = died_s(run, x.of);
  const auto since_s = x.requester.front()->ended_s;
  return !until_s
         || (since_s < *until_s
             && carried_s(run, x.of, known, since_s, *until_s) > longest_s);
}

} // namespace

void check_ledger(const finished_run& run, broken_promises& to) {
  const auto known = troubles_of(run);
  for (const auto& x : sessions_of(run)) {
    const auto who = fmt::format("session {} of {} of station {} at {} ({})",
                                 x.of.counter, x.of.service, x.of.station,
                                 x.of.provider, x.of.provider_id);
    if (x.requester.size() > 1 || x.provider.size() > 1)
      to.push_back({"closed_once",
                    fmt::format("{} was closed {} times by the "
                                "vehicle and {} by the provider",
                                who, x.requester.size(), x.provider.size())});
    else if (x.provider.empty() && has_heard(run, x, known))
      to.push_back({"closed_by_both",
                    fmt::format("{}, which the vehicle closed at {:.3f} s, was "
                                "never closed by the provider",
                                who, x.requester.front()->ended_s)});
    else if (x.requester.empty()) {
      const auto& p = *x.provider.front();
      const auto dies_s = dies_at_s(run.what, x.of.station);
      const auto since_s = std::max(p.accepted_s, dies_s.value_or(0));
      if (p.ended_s - since_s > longest_start_s)
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
