// Random mixes of sessions on the queue that providers have, and on one by
// deadlines: whether responses keep what was stated of them.
#include "channel/provider_compute.hpp"
#include "channel/server_queue.hpp"
#include "policies/algorithms/scheduling/response_time.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/edf_workers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr auto length = 10s;
constexpr int random_phasings = 8;

/// A number of mixes; SOFOF_MIXES asks for more, or for fewer.
std::uint64_t mixes() {
  const auto* wanted = std::getenv("SOFOF_MIXES");
  return wanted ? std::strtoull(wanted, nullptr, 10) : 100;
}

/// Sessions, and what computes them: a cycle of a group takes `demand` times
/// what the computer draws.
struct drawn_mix {
  std::vector<session_group> groups;
  std::vector<double> demands;
  provider_compute computer;
  double load = 0; ///< By C, of all workers.
};

duration milliseconds(dice& draw, double low, double high) {
  return from_seconds(1e-3 * draw.between(low, high));
}

/// A law of computing times, and what is said of it.
struct law {
  delay_distribution draws;
  draw_bound bound;
};

law bounded_law(dice& draw) {
  const auto kind = draw.between(0, 3);
  const auto all = kind < 1 ? delay_distribution::uniform(5ms, 5ms)
                   : kind < 2
                       ? delay_distribution::uniform(2ms, 5ms)
                       : delay_distribution::beta(5ms, 0.646, 2.11).kept(0.9);
  return {all, all.bound()};
}

/// An exponential one may say more overruns than `rare`, so that there are
/// some.
law endless_law(dice& draw) {
  if (draw.between(0, 3) < 1) {
    const auto all = delay_distribution::lognormal(0ms, 3ms, 1ms);
    return {all, all.bound()};
  }
  const auto often = std::pow(10, draw.between(-4.5, -2.5));
  const auto mean_s = 1e-3;
  auto all = delay_distribution::exponential(1ms);
  if (draw.between(0, 2) < 1)
    all = all.kept(0.5);
  return {all, {-mean_s * std::log(often), often, mean_s * often}};
}

drawn_mix draw_mix(dice& draw, const law& times) {
  drawn_mix mix;
  constexpr std::array workers{1, 1, 2, 3, 8};
  mix.computer.workers = workers[static_cast<std::size_t>(draw.between(0, 5))];
  mix.computer.alone = times.draws;
  const auto kinds = static_cast<int>(draw.between(1, 5));
  const auto most_alike = draw.between(0, 3) < 1 ? 2 : 10; // but one
  double load = 0;
  for (int k = 0; k < kinds; ++k) {
    const auto period = milliseconds(draw, 10, 200);
    session_group group{
        {.period = period,
         .deadline = from_seconds(to_seconds(period) * draw.between(0.3, 2))},
        static_cast<std::size_t>(draw.between(1, most_alike))};
    const auto kind = draw.between(0, 4);
    if (kind < 1)
      group.task.jitter = jitter_with_first_cycle(period);
    else if (kind < 2)
      group.task.jitter = from_seconds(to_seconds(period) * draw.between(0, 2));
    mix.groups.push_back(group);
    mix.demands.push_back(draw.between(0.2, 2));
    load += static_cast<double>(group.count) * mix.demands.back()
            * times.bound.at_most_s / to_seconds(period);
  }
  mix.load = draw.between(0.1, 0.95);
  const auto scale =
      mix.load * static_cast<double>(mix.computer.workers) / load;
  for (std::size_t j = 0; j < mix.groups.size(); ++j) {
    auto& task = mix.groups[j].task;
    auto& demand = mix.demands[j];
    demand *= scale;
    task.wcet = from_seconds(times.bound.at_most_s * demand);
    task.overrun = {times.bound.probability, times.bound.beyond_s * demand};
  }
  return mix;
}

/// How sessions begin: at random, or all together, with jobs of the longest
/// time, and so that this group has most to wait for.
struct worst_for {
  std::size_t group = 0;
  duration later{};                   ///< It begins so much after the others,
  std::optional<std::size_t> first{}; ///< these an instant before them.
};
using phasing = std::optional<worst_for>;

/// Adds the jobs of a session.
void add_session(const drawn_mix& mix, std::size_t group, const phasing& how,
                 dice& draw, std::vector<timed_job>& jobs) {
  const auto& task = mix.groups[group].task;
  time_point begin{1s};
  if (how && how->group == group)
    begin += how->later;
  else if (how && how->first == group)
    begin -= 1ns;
  const random_stream draws{static_cast<std::uint64_t>(draw.between(0, 1e9)),
                            "computing"};
  const auto at = [&](double share, duration of) {
    return from_seconds(to_seconds(of) * share);
  };
  auto nominal = begin - task.jitter;
  if (!how)
    nominal -= at(draw.between(0, 1), task.period);
  auto earliest = time_point::min();
  const auto end = time_point{how ? 3s : length};
  for (std::uint64_t k = 0; nominal < end; ++k, nominal += task.period) {
    const auto delay = how ? std::max(begin - nominal, duration{0})
                           : at(draw.between(0, 1), task.jitter);
    earliest = std::max(nominal + delay, earliest); // none overtakes another
    jobs.push_back(
        {earliest, earliest + task.deadline,
         how ? task.wcet
             : mix.computer.computing_time(draws, k, mix.demands[group]),
         group});
  }
}

std::vector<timed_job> jobs_of(const drawn_mix& mix, const phasing& how,
                               dice& draw) {
  std::vector<timed_job> jobs;
  const auto add = [&](std::size_t group) {
    for (std::size_t k = 0; k < mix.groups[group].count; ++k)
      add_session(mix, group, how, draw, jobs);
  };
  for (std::size_t j = 0; j < mix.groups.size(); ++j)
    if (!how || j != how->group)
      add(j);
  if (how)
    add(how->group); // behind all that come at the same time
  std::ranges::stable_sort(jobs, {}, &timed_job::release);
  return jobs;
}

std::vector<time_point> finish(const std::vector<timed_job>& jobs,
                               queue_order order, std::size_t workers) {
  if (order == queue_order::edf)
    return finish_by_deadlines(jobs, workers);
  server_queue queue{static_cast<unsigned>(workers)};
  std::vector<time_point> done;
  for (const auto& job : jobs)
    done.push_back(queue.finish(job.release, job.work));
  return done;
}

/// What was measured of a group.
struct measured {
  duration worst{};
  double jobs = 0, later = 0; ///< Than stated.
};

void play(const drawn_mix& mix, queue_order order, const phasing& how,
          dice& draw, const std::vector<response_quantile>& stated,
          std::vector<measured>& all) {
  const auto jobs = jobs_of(mix, how, draw);
  const auto done =
      finish(jobs, order, static_cast<std::size_t>(mix.computer.workers));
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const auto response = done[k] - jobs[k].release;
    auto& of = all[jobs[k].group];
    of.worst = std::max(of.worst, response);
    ++of.jobs;
    of.later += response > stated[jobs[k].group].at_most;
  }
}

std::vector<phasing> worst_phasings(const drawn_mix& mix, queue_order order) {
  std::vector<phasing> all;
  const auto& groups = mix.groups;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    all.push_back(worst_for{g});
    for (std::size_t j = 0; j < groups.size(); ++j)
      if (const auto more = groups[j].task.deadline - groups[g].task.deadline;
          order == queue_order::edf && more > duration{0}) {
        all.push_back(worst_for{g, more});
        all.push_back(worst_for{g, duration{0}, j});
      }
  }
  return all;
}

std::vector<measured> measure(const drawn_mix& mix, queue_order order,
                              const std::vector<response_quantile>& stated,
                              bool with_worst, dice& draw) {
  std::vector<measured> all(mix.groups.size());
  if (with_worst)
    for (const auto& how : worst_phasings(mix, order))
      play(mix, order, how, draw, stated, all);
  for (int k = 0; k < random_phasings; ++k)
    play(mix, order, std::nullopt, draw, stated, all);
  return all;
}

/// How far bounds were from what was measured.
struct tightness {
  int mixes = 0, exceeded = 0, loaded = 0, near = 0;

  void add(const drawn_mix& mix, const std::vector<response_quantile>& stated,
           const std::vector<measured>& seen) {
    double ratio = 0;
    double later = 0;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      later += seen[j].later;
      ratio = std::max(ratio, to_seconds(stated[j].at_most)
                                  / to_seconds(seen[j].worst));
    }
    ++mixes;
    exceeded += later > 0;
    loaded += mix.load >= 0.5;
    near += mix.load >= 0.5 && ratio <= 1.5;
  }
};

std::vector<response_quantile> worst_of(const drawn_mix& mix,
                                        queue_order order) {
  const auto all = worst_case_responses(
      mix.groups, order, static_cast<std::size_t>(mix.computer.workers));
  REQUIRE(all);
  std::vector<response_quantile> stated;
  for (const auto response : *all)
    stated.push_back({response, 0});
  return stated;
}

void check_bounds(std::string_view name, queue_order order) {
  tightness all;
  for (std::uint64_t seed = 1; seed <= mixes(); ++seed) {
    CAPTURE(seed);
    dice draw{seed};
    const auto mix = draw_mix(draw, bounded_law(draw));
    const auto stated = worst_of(mix, order);
    all.add(mix, stated, measure(mix, order, stated, true, draw));
  }
  MESSAGE(name << ": mixes " << all.mixes << ", exceeded " << all.exceeded
               << ", loaded " << all.loaded << ", near " << all.near);
  CHECK(all.exceeded == 0);
  CHECK(2 * all.near >= all.loaded);
}

} // namespace

TEST_CASE("no response is longer than the worst case, which is near, first "
          "come, first served") {
  check_bounds("first come", queue_order::fifo);
}

TEST_CASE("no response is longer than the worst case, which is near, by "
          "deadlines") {
  check_bounds("by deadlines", queue_order::edf);
}

TEST_CASE("where computing times have no end, no more results are later than "
          "stated") {
  int all = 0, above = 0;
  double jobs = 0, later = 0, stated_later = 0;
  for (std::uint64_t seed = 1; seed <= mixes(); ++seed) {
    CAPTURE(seed);
    dice draw{seed};
    const auto mix = draw_mix(draw, endless_law(draw));
    const auto stated = stated_responses(
        mix.groups, static_cast<std::size_t>(mix.computer.workers));
    REQUIRE(stated);
    const auto seen = measure(mix, queue_order::fifo, *stated, false, draw);
    for (std::size_t j = 0; j < seen.size(); ++j) {
      ++all;
      // As many as chance would add to rare ones in one of a thousand, at most.
      const auto most = (*stated)[j].later * seen[j].jobs;
      above += seen[j].later > most + 3 * std::sqrt(most) + 1;
      jobs += seen[j].jobs;
      later += seen[j].later;
      stated_later += std::min(most, seen[j].jobs);
    }
  }
  MESSAGE("quantiles: mixes " << mixes() << ", services " << all
                              << ", more often " << above << ", results "
                              << jobs << ", later " << later << ", stated "
                              << stated_later);
  CHECK(above == 0);
  CHECK(later <= stated_later);
}
