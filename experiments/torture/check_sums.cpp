// Holds the figures of a summary to the files beside it.
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace sofof::experiments::torture {

namespace {

/// What the files say of a service.
struct service_sums {
  double episodes = 0, closed = 0, fallbacks = 0, served = 0;
  double t_off_s = 0, longest_t_off_s = 0, whole = 0; ///< Not cut off.
  double results = 0, used = 0, latency_ms = 0;
  std::map<std::string, double> ended_by, served_ended_by;
};

class sum_checker {
public:
  sum_checker(const finished_run& run, broken_promises& to)
      : run_{run}, to_{to} {
    for (const auto& type : run.what.services)
      sums_[std::string{type->name()}];
    for (const auto& x : run.episodes)
      add(x, sums_[x.of.service]);
    for (const auto& x : run.cycles) {
      auto& s = sums_[x.of.service];
      ++s.results;
      s.used += x.used;
      s.latency_ms += x.latency_ms;
      add_parts(x);
    }
  }

  void check() {
    for (const auto& [service, s] : sums_)
      check(fmt::format("services.{}.", service), s);
    same("Σ ended_by + running_at_end",
         sum_of("ended_by.") + run_.figure("running_at_end"),
         "episodes + no_data",
         run_.figure("episodes") + run_.figure("no_data"));
    if (std::abs(worst_part_ms_) > 2e-6)
      tell(fmt::format("the parts of an input's age differ from it by {} ms",
                       worst_part_ms_));
  }

private:
  static void add(const report::episode_line& x, service_sums& s) {
    if (!x.by_requester) {
      ++s.served;
      ++s.served_ended_by[x.reason];
      return;
    }
    ++s.closed;
    ++s.ended_by[x.reason];
    s.fallbacks += x.fallback;
    if (!x.first_data_s)
      return;
    ++s.episodes;
    if (x.t_off_s && !x.is_cut_off()) {
      ++s.whole;
      s.t_off_s += *x.t_off_s;
      s.longest_t_off_s = std::max(s.longest_t_off_s, *x.t_off_s);
    }
  }

  void add_parts(const report::cycle_line& x) {
    if (!x.parts || !x.input_age_ms)
      return;
    const auto& p = *x.parts;
    const auto off = *x.input_age_ms - p.uplink_wait - p.uplink - p.rest
                     - p.queue - p.computing - p.downlink_wait - p.downlink;
    if (std::abs(off) > std::abs(worst_part_ms_))
      worst_part_ms_ = off;
  }

  void check(const std::string& of, const service_sums& s) {
    const auto is = [&](const std::string& figure, double wanted,
                        double off = 0) {
      same(of + figure, run_.figure(of + figure), "the files", wanted, off);
    };
    is("requests", run_.figure(of + "accepted") + run_.figure(of + "rejected"));
    // Vehicles whose computer died have closed nothing.
    is("episodes", s.episodes + run_.figure(of + "running_at_end"));
    is("no_data", s.closed - s.episodes);
    is("fallbacks", s.fallbacks);
    if (!any_dies(run_.what))
      is("running_at_end", 0);
    is("served.count", s.served);
    is("results_used", s.used);
    is("latency_ms.count", s.results);
    if (s.results > 0)
      is("latency_ms.mean", s.latency_ms / s.results, 2e-6);
    if (s.whole > 0) {
      is("t_off_s.mean", s.t_off_s / s.whole, 2e-6);
      is("t_off_s.max", s.longest_t_off_s, 2e-6);
    }
    for (const auto& [reason, count] : s.ended_by)
      is("ended_by." + reason, count);
    for (const auto& [reason, count] : s.served_ended_by)
      is("served.ended_by." + reason, count);
  }

  double sum_of(const std::string& prefix) const {
    double sum = 0;
    for (auto f = run_.summary.figures.lower_bound(prefix);
         f != run_.summary.figures.end() && f->first.starts_with(prefix); ++f)
      sum += f->second;
    return sum;
  }

  void same(const std::string& what, double is, const std::string& other,
            double wanted, double off = 0) {
    if (std::abs(is - wanted) > off)
      tell(fmt::format("{} is {}, but {} say {}", what, is, other, wanted));
  }

  void tell(std::string what) { to_.push_back({"adds_up", std::move(what)}); }

  const finished_run& run_;
  broken_promises& to_;
  std::map<std::string, service_sums> sums_;
  double worst_part_ms_ = 0;
};

} // namespace

void check_sums(const finished_run& run, broken_promises& to) {
  sum_checker{run, to}.check();
}

void check_octets(const finished_run& run, broken_promises& to) {
  std::map<std::string, double> by_figure;
  using way = std::tuple<std::string, std::string, std::string>;
  std::set<way> lost_octets, lost_messages;
  for (const auto& x : run.octets) {
    if (x.sent != x.delivered + x.lost + x.under_way)
      to.push_back(
          {"octets",
           fmt::format("of {} octets {} of {} for {} at {} s {} arrived, {} "
                       "were lost and {} are under way",
                       x.sent, x.direction, x.provider, x.what,
                       x.t_s.value_or(0), x.delivered, x.lost, x.under_way)});
    by_figure[fmt::format("services.{}.octets.{}", x.what, x.direction)] +=
        static_cast<double>(x.sent);
    if (x.lost > 0)
      lost_octets.emplace(x.provider, x.direction, x.what);
  }
  for (const auto& cell : run.disturbed.cells)
    for (const auto& x : cell.disturbed)
      if (x.count.lost + x.count.outage > 0)
        lost_messages.emplace(cell.provider, cell.direction, x.what);
  if (lost_octets != lost_messages)
    to.push_back({"octets", "octets.csv and disturbed.csv do not agree what "
                            "was lost"});
  for (const auto& [figure, sent] : by_figure)
    if (run.summary.figures.contains(figure) && run.figure(figure) != sent)
      to.push_back({"octets", fmt::format("{} is {}, but octets.csv says {}",
                                          figure, run.figure(figure), sent)});
}

} // namespace sofof::experiments::torture
