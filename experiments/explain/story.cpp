// Lines in the order of time, and why it ended at their end.
#include "experiments/explain/story.hpp"

#include "base/input_error.hpp"
#include "base/text/wrapped.hpp"
#include "experiments/explain/cause.hpp"
#include "experiments/explain/episode_files.hpp"
#include "messages/protocol/service.hpp"
#include "recording/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::explain {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t line_width = 80;
constexpr std::size_t enough_for_a_rule = 20; // results

bool ended_early(const closed_episode& x) {
  using messages::end_reason;
  for (int k = 0; k <= static_cast<int>(last_of(end_reason{})); ++k)
    if (const auto reason = static_cast<end_reason>(k);
        messages::name_of(reason) == x.reason)
      return !messages::is_planned(reason);
  return true;
}

/// @returns how far an episode is from a moment, s; 0 when it runs then.
double distance_s(const closed_episode& x, double at_s) {
  return std::max({x.accepted_s - at_s, at_s - x.ended_s, 0.0});
}

/// @returns the episode that is asked about.
const closed_episode& find(const std::vector<closed_episode>& all,
                           const question& q, const fs::path& folder) {
  std::vector<const closed_episode*> possible;
  for (const auto& x : all)
    if (x.by_requester && (!q.station || x.of.station == *q.station)
        && (q.service.empty() || x.of.service == q.service))
      possible.push_back(&x);
  if (possible.empty())
    throw input_error{fmt::format(
        "{}: no vehicle has closed an episode{}{}; episodes.csv lists all.",
        folder.string(),
        q.station ? fmt::format(" as station {}", *q.station) : "",
        q.service.empty() ? "" : fmt::format(" of {}", q.service))};
  if (q.at_s)
    return **std::ranges::min_element(
        possible, {}, [&q](const auto* x) { return distance_s(*x, *q.at_s); });
  const auto early = std::ranges::find_if(
      possible, [](const auto* x) { return ended_early(*x); });
  if (early != possible.end())
    return **early;
  return **std::ranges::max_element(
      possible, {}, [](const auto* x) { return x->ended_s - x->accepted_s; });
}

/// All that is known of one episode.
struct episode {
  closed_episode closed;
  std::optional<closed_episode> at_provider;
  std::optional<closed_episode> next;     ///< Of this service and vehicle.
  std::vector<report::event_line> events; ///< Of this vehicle and provider.
  std::optional<std::vector<received_result>> results;
  /// Share of the octets that the provider sent for the service, to whom ever.
  std::optional<double> lost;
  bool has_gaps = false; ///< Some results between others did not come.
  asked_shares load;     ///< Of the provider, about the end.
};

episode open(const fs::path& folder, const question& q) {
  const auto all = read_episodes(folder);
  episode found;
  found.closed = find(all, q, folder);
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
  found.results = read_results(folder, of);
  found.lost = lost_share(folder, of.provider, of.service);
  found.has_gaps = has_gaps(folder, of);
  if (!of.provider.empty())
    found.load = read_load(folder, of.provider, found.closed.ended_s);
  return found;
}

/// Lines with a time, in its order, and lines that belong to these.
class lines {
public:
  void at(double t_s, std::string_view text) {
    all_.emplace_back(t_s, fmt::format("{:>10.3f} s  {}\n", t_s, text));
  }
  void more(std::string_view text) {
    all_.back().second += fmt::format("{:>12}  {}\n", "", text);
  }

  std::string take() {
    std::ranges::stable_sort(all_, {}, &std::pair<double, std::string>::first);
    std::string text;
    for (const auto& [t_s, line] : all_)
      text += line;
    return text;
  }

private:
  std::vector<std::pair<double, std::string>> all_;
};

/// @returns " (value 578.5 ms, limit 500.0 ms)" of what an event or an episode
/// says of a limit; other words as they are; nothing for none.
std::string in_brackets(std::string_view because) {
  const auto number = [because](std::string_view name) {
    const auto begins = because.find(name);
    return begins == because.npos
               ? std::optional<double>{}
               : std::optional{std::strtod(
                   std::string{because.substr(begins + name.size())}.c_str(),
                   nullptr)};
  };
  const auto value = number("value_ms="), limit = number("limit_ms=");
  if (value && limit)
    return fmt::format(" ({:.1f} ms, limit {:.1f} ms)", *value, *limit);
  return because.empty() ? std::string{} : fmt::format(" ({})", because);
}

/// @returns the latest event of a kind until then, or null.
const report::event_line* latest(const episode& x, std::string_view what,
                                 double until_s) {
  const report::event_line* found = nullptr;
  for (const auto& event : x.events)
    if (event.what == what && event.t_s <= until_s
        && (event.of.service.empty()
            || event.of.service == x.closed.of.service))
      found = &event;
  return found;
}

void beginning(lines& to, const episode& x) {
  const auto& e = x.closed;
  if (const auto* offer = latest(x, "offer", e.accepted_s))
    to.at(offer->t_s, fmt::format("offer of {}", e.of.provider));
  const auto* accepted = latest(x, "accepted", e.accepted_s);
  to.at(e.accepted_s,
        fmt::format("accepted{}", accepted && !accepted->detail.empty()
                                      ? ": " + accepted->detail
                                      : ""));
  if (e.first_data_s)
    to.at(*e.first_data_s, "the first result in time: it is used from now on");
}

/// @returns "mean 12.0, at most 31.2 ms".
template <class Of>
std::string spread(std::span<const received_result> results, Of of) {
  double sum = 0, most = 0;
  for (const auto& x : results) {
    sum += of(x);
    most = std::max(most, of(x));
  }
  return fmt::format("mean {:.1f}, at most {:.1f} ms",
                     sum / static_cast<double>(results.size()), most);
}

void course(lines& to, const episode& x) {
  if (!x.results) {
    to.more("no results were recorded (record.cycles = false)");
    return;
  }
  const auto& results = *x.results;
  if (results.empty()) {
    to.more("no result came");
    return;
  }
  const auto used = std::ranges::count(results, true, &received_result::used);
  to.more(fmt::format("{} result{} came, {} used", results.size(),
                      results.size() == 1 ? "" : "s", used));
  to.more("latency "
          + spread(results, [](const auto& r) { return r.latency_ms; }));
  to.more("age of the input "
          + spread(results, [](const auto& r) { return r.input_age_ms; }));
  const auto& last = results.back();
  to.at(last.received_s,
        fmt::format("the last result: latency {:.1f} ms, input {:.1f} ms old",
                    last.latency_ms, last.input_age_ms));
  const auto of_age = x.closed.reason != "qos_latency";
  to.more(fmt::format("of the {}: {} ms", of_age ? "age" : "latency",
                      in_parts(last.ms, of_age)));
}

void load(lines& to, const episode& x) {
  std::string all;
  for (const auto& [what, share] : x.load)
    all += fmt::format("{}{} {:.0f} %", all.empty() ? "" : ", ", what,
                       100 * share);
  if (!all.empty())
    to.more(
        fmt::format("asked of {} just then: {}", x.closed.of.provider, all));
}

void ending(lines& to, const episode& x) {
  const auto& e = x.closed;
  to.at(e.ended_s,
        fmt::format("ended: {}{}", e.reason, in_brackets(e.because)));
  load(to, x);
  if (e.fallback)
    to.more("the vehicle's own function took over (a fallback)");
  if (x.at_provider)
    to.at(x.at_provider->ended_s,
          fmt::format("{} closed it: {}{}", e.of.provider,
                      x.at_provider->reason,
                      in_brackets(x.at_provider->because)));
  if (x.next)
    to.at(x.next->accepted_s,
          fmt::format("accepted again, at {}", x.next->of.provider));
}

/// @returns what was full, if a part of the time was for it.
std::string full(const episode& x, std::string_view part) {
  const auto is_for = [part](std::string_view what) {
    if (what == "workers")
      return part.ends_with("worker");
    return part.ends_with(what)
           || part == (what == "uplink" ? "way up" : "way down");
  };
  for (const auto& [what, share] : x.load)
    if (is_for(what) && share > recording::full_share)
      return fmt::format("; the {} {} asked for {:.0f} % just then", what,
                         what == "workers" ? "were" : "was", 100 * share);
  return "";
}

std::string why_slow(const episode& x, bool since_input) {
  const auto subject =
      since_input ? "the input was too old" : "it was too late";
  if (!x.results || x.results->empty())
    return fmt::format("{}; results were not recorded.", subject);
  const auto part = longest_part(*x.results, since_input);
  const auto usual = x.results->size() > 1
                         ? fmt::format(", {:.1f} as a rule", part.usual_ms)
                         : std::string{};
  return fmt::format("{}: the {} took {:.1f} ms{}{}.", subject, part.what,
                     part.ms, usual, full(x, part.what));
}

// What was held back comes later; an outage loses what is sent meanwhile, and
// ends a session before there are gaps in it.
std::string why_silent(const episode& x) {
  const auto& e = x.closed;
  if (x.at_provider && x.at_provider->ended_s < e.ended_s)
    return fmt::format("{} had closed it {:.3f} s before ({}).", e.of.provider,
                       e.ended_s - x.at_provider->ended_s,
                       x.at_provider->reason);
  if (!x.lost)
    return "nothing came: results were lost, or held back.";
  if (*x.lost == 0)
    return fmt::format(
        "nothing came, and nothing was lost in this run: the connection held "
        "results back{}.",
        x.at_provider ? fmt::format("; {} heard of the end {:.0f} ms later",
                                    e.of.provider,
                                    1e3 * (x.at_provider->ended_s - e.ended_s))
                      : std::string{});
  if (x.has_gaps)
    return fmt::format("results get lost: {:.1f} % of what {} sent for this "
                       "service in this run.",
                       100 * *x.lost, e.of.provider);
  return "nothing came: what was sent meanwhile was lost, as in an outage.";
}

std::string why_no_data(const episode& x) {
  if (!x.results || x.results->empty())
    return "after it was accepted, no result came.";
  return fmt::format(
      "results came, but none in time: latency {}.",
      spread(*x.results, [](const auto& r) { return r.latency_ms; }));
}

std::string why(const episode& x) {
  const auto& e = x.closed;
  const auto provider_says =
      x.at_provider ? x.at_provider->because : std::string{};
  if (e.reason == "qos_latency")
    return why_slow(x, false);
  if (e.reason == "qos_input_age")
    return why_slow(x, true);
  if (e.reason == "qos_gap")
    return why_silent(x);
  if (e.reason == "no_data")
    return why_no_data(x);
  if (e.reason == "cam_timeout")
    return fmt::format("{} heard nothing of the vehicle: its way up failed.",
                       e.of.provider);
  if (e.reason == "peer_lost")
    return fmt::format("{} is gone, or the connection to it.", e.of.provider);
  if (e.reason == "implausible")
    return fmt::format("a result failed the vehicle's check: {}.", e.because);
  const auto after_colon = [](const std::string& text) {
    return text.empty() ? std::string{} : ": " + text;
  };
  if (e.reason == "revoked")
    return fmt::format("the CODM of {} took its room back{}.", e.of.provider,
                       after_colon(provider_says));
  if (e.reason == "refused")
    return "the other side refused to go on.";
  if (e.reason == "released")
    return fmt::format("the vehicle gave it back{}.", after_colon(e.because));
  if (e.reason == "left_area")
    return fmt::format("the vehicle left the area of {}.", e.of.provider);
  if (e.reason == "handed_over")
    return "another provider had taken over.";
  return "the run ended, or the vehicle had arrived.";
}

} // namespace

std::string tell(const fs::path& folder, const question& question) {
  if (!fs::exists(folder / "episodes.csv"))
    throw input_error{fmt::format("{} is no results folder: it has no "
                                  "episodes.csv.",
                                  folder.string())};
  const auto x = open(folder, question);
  const auto& e = x.closed;
  lines to;
  beginning(to, x);
  course(to, x);
  ending(to, x);
  return fmt::format("Station {}, {} at {}: {:.3f} to {:.3f} s, {}\n{}{}\n",
                     e.of.station, e.of.service, e.of.provider, e.accepted_s,
                     e.ended_s,
                     ended_early(e) ? "ended early" : "ended as planned",
                     to.take(), wrapped("Why: " + why(x), line_width));
}

} // namespace sofof::experiments::explain
