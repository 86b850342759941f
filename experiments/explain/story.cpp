// Lines in the order of time, and why it ended at their end.
#include "experiments/explain/story.hpp"

#include "base/input_error.hpp"
#include "base/text/wrapped.hpp"
#include "experiments/explain/absence.hpp"
#include "experiments/explain/cause.hpp"
#include "messages/protocol/record.hpp"
#include "recording/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::explain {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t line_width = 80;

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
std::string spread(std::span<const report::cycle_line> results, Of of) {
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
  const auto used =
      std::ranges::count(results, true, &report::cycle_line::used);
  to.more(fmt::format("{} result{} came, {} used", results.size(),
                      results.size() == 1 ? "" : "s", used));
  to.more("latency "
          + spread(results, [](const auto& r) { return r.latency_ms; }));
  to.more("age of the input "
          + spread(results, [](const auto& r) { return *r.input_age_ms; }));
  const auto& last = results.back();
  to.at(last.received_s,
        fmt::format("the last result: latency {:.1f} ms, input {:.1f} ms old",
                    last.latency_ms, *last.input_age_ms));
  const auto of_age =
      x.closed.reason != "qos_latency" || counts_from_input(last);
  if (const auto parts = in_parts(*last.parts, of_age); !parts.empty())
    to.more(fmt::format("of the {}: {} ms", of_age ? "age" : "latency", parts));
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
  const auto part = longest_part(
      *x.results, since_input || counts_from_input(x.results->back()));
  const auto usual = x.results->size() > 1
                         ? fmt::format(", {:.1f} as a rule", part.usual_ms)
                         : std::string{};
  return fmt::format("{}: the {} took {:.1f} ms{}{}.", subject, part.what,
                     part.ms, usual, full(x, part.what));
}

std::string why_silent(const episode& x) {
  const auto& e = x.closed;
  const auto& provider = e.of.provider;
  if (x.at_provider && x.at_provider->ended_s < e.ended_s)
    return fmt::format("{} had closed it {:.3f} s before ({}).", provider,
                       e.ended_s - x.at_provider->ended_s,
                       x.at_provider->reason);
  if (!x.results)
    return "nothing came; what became of the results was not recorded.";
  if (!x.disturbed || !x.lost)
    return "nothing came: results were lost, or held back.";
  constexpr auto slow_ms = channel::slow_delay / std::chrono::milliseconds{1};
  switch (*x.disturbed) {
    case channel::disturbance::loss:
      return fmt::format("results get lost: {:.1f} % of what {} sent for this "
                         "service in this run.",
                         100 * *x.lost, provider);
    case channel::disturbance::outage:
      return "nothing came: what was sent meanwhile was lost in an outage.";
    case channel::disturbance::stall:
      return "nothing came: the connection stalled and held results back.";
    case channel::disturbance::slow:
      return fmt::format("nothing came in time: the network's own delay held "
                         "back what was due, by {} ms or more.",
                         slow_ms);
    default:
      return fmt::format("nothing came in time, though the network neither "
                         "lost what was due nor held it back by {} ms or "
                         "more: {} sent none, or it waited{}.",
                         slow_ms, provider,
                         full(x, "way down") + full(x, "worker"));
  }
}

std::string why_no_data(const episode& x) {
  const auto provider_says =
      x.at_provider && x.at_provider->reason == "no_data"
              && x.at_provider->because != messages::told_by_vehicle
          ? fmt::format(" ({}: {})", x.closed.of.provider,
                        x.at_provider->because)
          : std::string{};
  if (!x.results || x.results->empty())
    return fmt::format("after it was accepted, no result came{}.",
                       provider_says);
  return fmt::format(
      "results came, but none in time: latency {}.",
      spread(*x.results, [](const auto& r) { return r.latency_ms; }));
}

std::string why(const episode& x) {
  const auto& e = x.closed;
  const auto provider_says =
      x.at_provider && x.at_provider->because != messages::told_by_vehicle
          ? x.at_provider->because
          : std::string{};
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
  return x.cut_off ? "the run ended."
                   : "the vehicle had arrived, or its process was ended.";
}

/// @returns which of the episodes that are asked about it is, on a line.
std::string place_among(const episode& x, const question& q) {
  const auto& [all, early, services] = x.among;
  if (all == 1)
    return "";
  const auto of = services.size() > 1
                      ? fmt::format(" of {} services", services.size())
                      : std::string{};
  const auto early_ones =
      early == 0 ? std::string{"none"} : fmt::format("{}", early);
  if (q.at_s)
    return fmt::format("(one of {} episodes{}; {} ended early)\n", all, of,
                       early_ones);
  if (early == 0)
    return fmt::format("(the longest of {} episodes{}; none ended early)\n",
                       all, of);
  if (early == 1)
    return fmt::format("(the only one of {} episodes{} that ended early)\n",
                       all, of);
  return fmt::format("(the first of {} that ended early, of {} episodes{})\n",
                     early, all, of);
}

/// @returns how to ask about the other services at a time, on lines.
std::string others_then(const episode& x, const question& q) {
  std::string text;
  for (const auto& service : x.among.services)
    if (q.at_s && service != x.closed.of.service)
      text += fmt::format("(--service {} tells of that one then)\n", service);
  return text;
}

} // namespace

std::string tell(const fs::path& folder, const question& question) {
  if (!fs::exists(folder / "episodes.csv"))
    throw input_error{fmt::format("{} is no results folder: it has no "
                                  "episodes.csv.",
                                  folder.string())};
  if (question.at_s && !std::isfinite(*question.at_s))
    throw input_error{fmt::format("--at {:g} is no time.", *question.at_s)};
  const auto x = find_episode(folder, question);
  if (!x)
    return tell_absence(folder, question);
  const auto& e = x->closed;
  lines to;
  beginning(to, *x);
  course(to, *x);
  ending(to, *x);
  const auto nearest =
      question.at_s && distance_s(e, *question.at_s) > 0
          ? wrapped(tell_moment(folder, question) + ". The nearest episode:",
                    line_width)
                + '\n'
          : std::string{};
  const auto how = ended_early(e) ? "ended early"
                   : x->cut_off   ? "cut off"
                                  : "ended as planned";
  return fmt::format(
      "{}Station {}, {} at {}: {:.3f} to {:.3f} s, {}\n{}{}{}{}\n", nearest,
      e.of.station, e.of.service, e.of.provider, e.accepted_s, e.ended_s, how,
      place_among(*x, question), others_then(*x, question), to.take(),
      wrapped("Why: " + why(*x), line_width));
}

} // namespace sofof::experiments::explain
