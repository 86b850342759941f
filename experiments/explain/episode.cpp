// Lines of one session out of those of all.
#include "experiments/explain/episode.hpp"

#include "base/input_error.hpp"
#include "messages/protocol/service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sofof::experiments::explain {

namespace {

namespace fs = std::filesystem;
using report::cycle_line;
using report::episode_line;
using report::session_key;

std::vector<const episode_line*>
possible_of(const std::vector<episode_line>& all, const question& q) {
  std::vector<const episode_line*> possible;
  for (const auto& x : all)
    if (x.by_requester && q.is_about(x.of))
      possible.push_back(&x);
  return possible;
}

const episode_line* choose(const std::vector<const episode_line*>& possible,
                           const question& q) {
  if (possible.empty())
    return nullptr;
  if (q.at_s)
    return *std::ranges::min_element(
        possible, {}, [&q](const auto* x) { return distance_s(*x, *q.at_s); });
  const auto early = std::ranges::find_if(
      possible, [](const auto* x) { return ended_early(*x); });
  if (early != possible.end())
    return *early;
  return *std::ranges::max_element(
      possible, {}, [](const auto* x) { return x->ended_s - x->accepted_s; });
}

void read_results(const fs::path& folder, episode& to) {
  const auto& of = to.closed.of;
  auto lines = report::read_cycles(
      folder, [&of](const session_key& x) { return x == of; });
  if (!lines)
    return;
  for (const auto& x : *lines)
    if (!x.parts || !x.input_age_ms)
      throw input_error{fmt::format(
          "{}: this run is of a version that did not record where the time to "
          "a result went; run its config.toml again.",
          (folder / "cycles.csv").string())};
  to.results = std::move(*lines);
}

std::optional<double> lost_share(const fs::path& folder,
                                 const session_key& of) {
  std::uint64_t sent = 0, lost = 0;
  for (const auto& x : report::read_octets(folder))
    if (x.provider == of.provider && x.direction == "down"
        && x.what == of.service) {
      sent += x.sent;
      lost += x.lost;
    }
  if (sent == 0)
    return std::nullopt;
  return static_cast<double>(lost) / static_cast<double>(sent);
}

/// @param results  That came; the one after the last of them is missing.
std::optional<channel::disturbance>
disturbed_in(const fs::path& folder, const episode_line& x,
             const std::optional<std::vector<report::cycle_line>>& results) {
  constexpr double ms_per_s = 1e3;
  const auto all = report::read_disturbed(folder);
  if (!all || !results)
    return std::nullopt;
  const auto sent_at = [](const report::cycle_line& r) {
    return from_seconds(
        r.received_s - (r.parts->downlink_wait + r.parts->downlink) / ms_per_s);
  };
  auto last_sent = from_seconds(x.accepted_s);
  std::optional<duration> sent_after;
  if (!results->empty())
    last_sent = sent_at(results->back());
  if (results->size() > 1)
    sent_after = last_sent - sent_at((*results)[results->size() - 2]);
  const auto found =
      recording::disturbance_of(
          *all,
          {x.of.provider, "down", static_cast<std::uint32_t>(x.of.station),
           x.of.service},
          recording::due_next(last_sent, sent_after, from_seconds(x.ended_s)))
          .value_or(channel::disturbance::none);
  if (found == channel::disturbance::none && !all->tells_slow)
    return std::nullopt; // or it was slow
  return found;
}

bool ends_with_run(const fs::path& folder, const episode_line& x) {
  const auto summary = report::read_summary(folder);
  if (!summary)
    return false;
  const auto length = summary->figures.find("virtual_s");
  return length != summary->figures.end() && x.ended_s >= length->second;
}

asked_shares load_at(const fs::path& folder, const std::string& provider,
                     double at_s) {
  asked_shares all;
  const auto second = std::floor(at_s);
  for (const auto& x : report::read_load(folder))
    if (x.t_s >= second - 1 && x.t_s <= second && x.provider == provider)
      all[x.what] = std::max(all[x.what], x.asked_share);
  return all;
}

} // namespace

bool ended_early(const episode_line& x) {
  using messages::end_reason;
  for (int k = 0; k <= static_cast<int>(last_of(end_reason{})); ++k)
    if (const auto reason = static_cast<end_reason>(k);
        messages::name_of(reason) == x.reason)
      return !messages::is_planned(reason);
  return true;
}

double distance_s(const episode_line& x, double at_s) {
  return std::max({x.accepted_s - at_s, at_s - x.ended_s, 0.0});
}

std::optional<episode> find_episode(const fs::path& folder, const question& q) {
  const auto all = report::read_episodes(folder);
  const auto possible = possible_of(all, q);
  const auto* closed = choose(possible, q);
  if (!closed)
    return std::nullopt;
  episode found;
  found.closed = *closed;
  found.among = {possible.size(),
                 static_cast<std::size_t>(std::ranges::count_if(
                     possible, [](const auto* x) { return ended_early(*x); }))};
  for (const auto* x : possible)
    found.among.services.insert(x->of.service);
  found.cut_off =
      closed->reason == "shutdown" && ends_with_run(folder, *closed);
  const auto& of = found.closed.of;
  for (const auto& x : all) {
    if (x.of == of && !x.by_requester)
      found.at_provider = x;
    const auto is_later = x.by_requester && x.of.station == of.station
                          && x.of.service == of.service
                          && x.accepted_s >= found.closed.ended_s;
    if (is_later && (!found.next || x.accepted_s < found.next->accepted_s))
      found.next = x;
  }
  for (auto& event : report::read_events(folder))
    if (event.of.station == of.station
        && event.of.provider_id == of.provider_id)
      found.events.push_back(std::move(event));
  read_results(folder, found);
  found.lost = lost_share(folder, of);
  found.disturbed = disturbed_in(folder, found.closed, found.results);
  if (!of.provider.empty())
    found.load = load_at(folder, of.provider, found.closed.ended_s);
  return found;
}

} // namespace sofof::experiments::explain
