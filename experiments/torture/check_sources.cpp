// Holds used results to their source, their order, their limits and their gaps.
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sofof::experiments::torture {

namespace {

using report::session_key;

/// Times in files are exact to the nanosecond, and so are limits.
constexpr double rounding_s = 5e-10, rounding_ms = 5e-7;
/// So many of a kind are told.
constexpr int most_told = 3;

class source_checker {
public:
  source_checker(const finished_run& run, broken_promises& to)
      : run_{run}, to_{to} {
    for (const auto& line : run.episodes)
      if (line.by_requester)
        episodes_.emplace(line.of, &line);
    for (const auto& type : run.what.services)
      limits_.emplace(type->name(), type->options.limits);
  }

  void check() {
    for (const auto& line : run_.cycles)
      if (line.used)
        look_at(line);
    check_gaps();
  }

private:
  void tell(std::string promise, const session_key& of, double at_s,
            const std::string& what) {
    if (++told_[promise] <= most_told)
      to_.push_back({std::move(promise),
                     fmt::format("station {}, {}, {} session {}, {:.6f} s: {}",
                                 of.station, of.service, of.provider,
                                 of.counter, at_s, what)});
  }

  void look_at(const report::cycle_line& x) {
    check_limits(x);
    used_[{x.of.station, x.of.service}].push_back(x.received_s);
    const auto found = episodes_.find(x.of);
    if (found == episodes_.end() && dies_at_s(run_.what, x.of.station))
      return; // nobody was there to close it
    if (found == episodes_.end())
      return tell("one_source", x.of, x.received_s,
                  "a result was used of a session that the vehicle never "
                  "closed");
    const auto& in = *found->second;
    if (!in.first_data_s || x.received_s < *in.first_data_s - rounding_s
        || x.received_s > in.ended_s + rounding_s)
      tell("one_source", x.of, x.received_s,
           "a result was used while its session was not the source");
    if (const auto [last, is_first] = last_cycle_.try_emplace(x.of, x.cycle);
        !is_first) {
      if (x.cycle <= last->second)
        tell("in_order", x.of, x.received_s,
             fmt::format("cycle {} was used after {}", x.cycle, last->second));
      last->second = x.cycle;
    }
  }

  void check_limits(const report::cycle_line& x) {
    const auto limits = limits_.find(x.of.service);
    if (limits == limits_.end())
      return tell("in_time", x.of, x.received_s, "there is no such service");
    const auto& l = limits->second;
    if (x.latency_ms > to_milliseconds(l.max_latency) + rounding_ms)
      tell("in_time", x.of, x.received_s,
           fmt::format("a result of {} ms was used", x.latency_ms));
    if (x.input_age_ms
        && *x.input_age_ms > to_milliseconds(l.max_input_age) + rounding_ms)
      tell("in_time", x.of, x.received_s,
           fmt::format("a result of an input of {} ms was used",
                       *x.input_age_ms));
  }

  /// While providers are the source no gap is longer than the limit, and a
  /// nanosecond.
  void check_gaps() {
    using who = std::pair<std::uint64_t, std::string>;
    struct remote {
      double from_s;
      session_key of;
    };
    std::map<who, remote> since; // of those that are remote now
    const auto look = [&](const who& w, double from_s, double to_s,
                          const session_key& of) {
      const auto limits = limits_.find(w.second);
      if (limits == limits_.end())
        return;
      const auto most_s =
          to_seconds(limits->second.max_interarrival) + 1e-9 + rounding_s;
      const auto& used = used_[w];
      auto last = from_s;
      for (auto t = std::ranges::lower_bound(used, from_s - rounding_s);
           t != used.end() && *t <= to_s + rounding_s; ++t) {
        if (*t - last > most_s)
          tell("no_gap", of, *t,
               fmt::format("no result had been used for {:.6f} s", *t - last));
        last = *t;
      }
      if (to_s - last > most_s)
        tell("no_gap", of, to_s,
             fmt::format("no result had been used for {:.6f} s", to_s - last));
    };
    for (const auto& e : run_.events) {
      if (e.what != "switch")
        continue;
      const who w{e.of.station, e.of.service};
      const auto is_remote = e.detail == "remote";
      const auto found = since.find(w);
      if (!is_remote && found == since.end())
        tell("one_source", e.of, e.t_s, "it went home, and was there already");
      if (is_remote && found == since.end())
        since.emplace(w, remote{e.t_s, e.of});
      if (!is_remote && found != since.end()) {
        look(w, found->second.from_s, e.t_s, e.of);
        since.erase(found);
      }
    }
    for (const auto& [w, x] : since) // until it died, or the run ended
      look(w, x.from_s,
           dies_at_s(run_.what, w.first).value_or(to_seconds(run_.what.length)),
           x.of);
  }

  const finished_run& run_;
  broken_promises& to_;
  std::map<session_key, const report::episode_line*> episodes_;
  std::map<std::string, messages::qos_limits, std::less<>> limits_;
  std::map<session_key, std::uint64_t> last_cycle_;
  std::map<std::pair<std::uint64_t, std::string>, std::vector<double>> used_;
  std::map<std::string, int> told_;
};

} // namespace

void check_sources(const finished_run& run, broken_promises& to) {
  source_checker{run, to}.check();
}

} // namespace sofof::experiments::torture
