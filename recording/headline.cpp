// From counts to sentences.
#include "recording/headline.hpp"

#include "recording/safety_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ranges>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::recording {

namespace {

using messages::end_reason;

/// What ended early, in a word or two.
std::string_view in_words(end_reason reason) {
  switch (reason) {
    case end_reason::qos_latency:
      return "latency";
    case end_reason::qos_input_age:
      return "the age of inputs";
    case end_reason::qos_gap:
      return "gaps between results";
    case end_reason::cam_timeout:
      return "CAMs that did not come";
    case end_reason::no_data:
      return "results that did not come";
    case end_reason::refused:
      return "refusal";
    case end_reason::peer_lost:
      return "loss of the provider";
    case end_reason::revoked:
      return "revocation";
    case end_reason::implausible:
      return "implausible results";
    default:
      return messages::name_of(reason);
  }
}

/// @returns what made gaps between results, in words.
std::string_view in_words(channel::disturbance of_results) {
  switch (of_results) {
    case channel::disturbance::loss:
      return "gaps, as results were lost";
    case channel::disturbance::outage:
      return "gaps in outages";
    case channel::disturbance::stall:
      return "gaps, as stalls held results back";
    case channel::disturbance::slow:
      return "gaps, as the network was slow";
    default:
      return in_words(end_reason::qos_gap);
  }
}

/// @returns why an episode ended early, in a few words.
std::string in_words(const early_end& x) {
  const auto takes_time = x.reason == end_reason::qos_latency
                          || x.reason == end_reason::qos_input_age;
  if (takes_time && !x.mostly.empty())
    return fmt::format("{}, mostly {}", in_words(x.reason), x.mostly);
  if (x.reason != end_reason::qos_gap)
    return std::string{in_words(x.reason)};
  return std::string{
      in_words(x.disturbed.value_or(channel::disturbance::none))};
}

using provider_counts = std::vector<std::pair<std::string, std::uint64_t>>;

/// Most often first, those that are as frequent by name.
void sort(provider_counts& counts) {
  std::ranges::stable_sort(counts, std::ranges::greater{},
                           &provider_counts::value_type::second);
}

/// @returns "junction 16, east 4".
std::string listed(const provider_counts& counts) {
  std::string all;
  for (const auto& [provider, count] : counts)
    all += fmt::format("{}{} {}", all.empty() ? "" : ", ", provider, count);
  return all;
}

/// @returns ": 18 by latency (junction 16, east 2), 3 by revocation (west 3)";
/// of one reason alone ", all by latency (junction 16, east 4)".
std::string early_ends(const service_metrics& x) {
  using reason_and_cause = std::pair<end_reason, std::string>;
  std::map<reason_and_cause, std::map<std::string, std::uint64_t>> counts;
  for (const auto& end : x.early)
    ++counts[{end.reason, in_words(end)}][end.provider];
  struct group {
    std::string cause;
    std::uint64_t count = 0;
    provider_counts at;
  };
  std::vector<group> groups;
  for (const auto& [why, at] : counts) {
    auto& one = groups.emplace_back(group{why.second, 0, {}});
    for (const auto& [provider, count] : at) {
      one.count += count;
      one.at.emplace_back(provider, count);
    }
    sort(one.at);
  }
  std::ranges::stable_sort(groups, std::ranges::greater{}, &group::count);
  if (groups.size() == 1)
    return fmt::format(", {} by {} ({})",
                       groups.front().count > 1 ? "all" : "that",
                       groups.front().cause, listed(groups.front().at));
  std::string all;
  for (const auto& g : groups)
    all += fmt::format("{} {} by {} ({})", all.empty() ? ":" : ",", g.count,
                       g.cause, listed(g.at));
  return all;
}

/// @returns "; most often (12 times): no room", if anything is known.
std::string most_frequent(const std::map<std::string, std::uint64_t>& counts) {
  const auto most = std::ranges::max_element(
      counts, {}, &std::map<std::string, std::uint64_t>::value_type::second);
  return most == counts.end()
             ? std::string{}
             : fmt::format("; most often ({} time{}): {}", most->second,
                           most->second == 1 ? "" : "s", most->first);
}

/// @returns " trajectory_planning" where there are others.
std::string name_among(const service_metrics& x, const run_info& run) {
  return run.services.size() > 1 ? fmt::format(" {}", x.service.view())
                                 : std::string{};
}

std::string offloading_of(const service_metrics& x, duration driven,
                          const run_info& run) {
  const auto name = name_among(x, run);
  if (x.episodes == 0)
    return fmt::format("Never offloaded{}: {}", name, why_never(x));
  const auto share = x.offloaded_share(driven);
  auto text =
      share ? fmt::format("Offloaded{} {:.1f} % of the time; ", name,
                          100 * *share)
            : fmt::format("Offloaded{}, for what share of the driving is not "
                          "known; ",
                          name);
  if (x.early.empty())
    return text
           + (x.episodes == 1
                  ? std::string{"the one episode did not end early."}
                  : fmt::format("none of {} episodes ended early.",
                                x.episodes));
  return text
         + fmt::format("{} of {} episode{} ended early{}.", x.early.size(),
                       x.episodes, x.episodes == 1 ? "" : "s", early_ends(x));
}

/// @returns the same of the service that the run is about, and of each other
/// one that did not go well.
std::string offloading_of(const metrics& m, const run_info& run) {
  const auto driven = m.safety().driven;
  constexpr std::size_t most = 2; // of the others
  auto text = offloading_of(m.headline(), driven, run);
  std::size_t others = 0;
  for (const auto& x : m.services())
    if (&x != &m.headline() && (x.episodes == 0 || !x.early.empty())
        && ++others <= most)
      text += ' ' + offloading_of(x, driven, run);
  if (others > most)
    text += fmt::format(" {} more did not go well.", others - most);
  return text;
}

std::string safety_of(const safety_metrics& x) {
  if (x.driven == duration::zero())
    return "Safety was not recorded.";
  const auto near = fmt::format("{} near miss{}", x.near_misses,
                                x.near_misses == 1 ? "" : "es");
  if (x.ok())
    return fmt::format("Safe: always a fresh plan, never off the road, no "
                       "collision; {}.",
                       near);
  return fmt::format("NOT SAFE: {:.3f} s without a fresh plan, {:.3f} s off "
                     "the road, {} collision{}; {}.",
                     to_seconds(x.without_fresh_plan), to_seconds(x.off_road),
                     x.collisions, x.collisions == 1 ? "" : "s", near);
}

std::string load_of(const load_table& table, bool is_modelled,
                    duration length) {
  if (table.servers.empty())
    return is_modelled
               ? "Nothing could be full: no computing and no airtime took time."
               : "What was full is not known in this process.";
  const auto full = full_ones(table, length);
  if (full.empty())
    return fmt::format(
        "No worker and no cell was asked for more than {:.0f} %.",
        100 * full_share);
  constexpr std::size_t most = 3;
  std::string all;
  for (const auto& [of, sum] : full | std::views::take(most))
    all += fmt::format("{}{} {} ({:.0f} % at most, for {:g} s)",
                       all.empty() ? "" : ", ", of->provider, of->what,
                       100 * sum.peak_share, sum.full_s);
  if (full.size() > most)
    all += fmt::format(" and {} more", full.size() - most);
  return fmt::format("Over {:.0f} % asked of {}", 100 * full_share, all) + '.';
}

} // namespace

std::string lateness_of(const standstill& x) {
  constexpr duration worth_a_word = std::chrono::milliseconds{100};
  if (x.together < worth_a_word)
    return "";
  return fmt::format("The machine kept a thread waiting that only looks at the "
                     "clock: {:.3f} s in all, {:.3f} s at once until {:.0f} s "
                     "after the start; plans may have been late, too.",
                     to_seconds(x.together), to_seconds(x.longest),
                     to_seconds(x.longest_at));
}

std::string why_never(const service_metrics& x) {
  if (x.offers == 0 && x.requests() == 0 && x.stayed.empty())
    return "nobody offered it.";
  if (x.requests() == 0)
    return fmt::format("the LODM asked for nothing{}.",
                       most_frequent(x.stayed));
  if (x.accepted == 0)
    return fmt::format("{} request{}, none accepted{}.", x.requests(),
                       x.requests() == 1 ? "" : "s", most_frequent(x.refused));
  return fmt::format("accepted {} time{}, but no result came in time.",
                     x.accepted, x.accepted == 1 ? "" : "s");
}

headline headline_of(const metrics& m, const run_info& run,
                     const run_end& end) {
  const auto late = lateness_of(end.stood_still);
  return {
      offloading_of(m, run),
      safety_of(m.safety()) + (late.empty() ? "" : ' ' + late),
      load_of(m.load(), run.clock == "virtual", from_seconds(end.virtual_s))};
}

} // namespace sofof::recording
