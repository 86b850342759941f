// Vehicles that get a result every period from one provider, without actors:
// what a channel profile does to latency, gaps and offloading durations.
#pragma once

#include "channel/link_direction.hpp"
#include "channel/provider_compute.hpp"
#include "channel/shared_server_queue.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

namespace sofof::test {

struct fleet {
  std::shared_ptr<const channel::channel_profile> profile;
  std::uint32_t vehicles = 1;
  duration period = std::chrono::milliseconds{50};
  duration length = std::chrono::seconds{68}; ///< Of one run.
  std::uint64_t seed = 1;
};

/// A result that arrived.
struct delivery {
  time_point created; ///< Begin of the planning cycle.
  time_point arrived;
  duration latency() const { return arrived - created; }
};

/// @returns for each vehicle what arrived, in order. The vehicles' phases are
/// drawn once and kept.
inline std::vector<std::vector<delivery>> run(const fleet& f) {
  struct job {
    std::uint32_t vehicle;
    std::uint64_t cycle;
    time_point created, computed;
  };
  const random_stream seed{f.seed, "fleet"};
  std::vector<random_stream> draws;
  std::vector<channel::link_direction> links;
  const auto cell = std::make_shared<channel::shared_server_queue>(1);
  const auto computers = channel::compute_measured_with(f.profile->name);
  std::vector<job> jobs;
  const auto cycles = static_cast<std::uint64_t>(f.length / f.period);
  jobs.reserve(f.vehicles * cycles);
  for (std::uint32_t v = 0; v < f.vehicles; ++v) {
    draws.push_back(channel::result_draws(seed, v, 0));
    links.emplace_back(channel::channel_draws{f.profile, seed, v, 0},
                       channel::direction::down, cell);
    const auto phase =
        from_seconds(seed.part("phase").uniform(0, to_seconds(f.period), v));
    for (std::uint64_t c = 0; c < cycles; ++c)
      jobs.push_back({v, c, time_point{phase + c * f.period}, {}});
  }
  std::ranges::stable_sort(jobs, {}, &job::created);
  channel::shared_server_queue workers{
      static_cast<unsigned>(computers.workers)};
  for (auto& j : jobs)
    j.computed = workers.finish(
        j.created, computers.computing_time(draws[j.vehicle], j.cycle));
  std::ranges::stable_sort(jobs, {}, &job::computed);
  std::vector<std::vector<delivery>> result(f.vehicles);
  for (const auto& j : jobs)
    if (const auto t = links[j.vehicle].arrival(
            j.computed, channel::message_class::result, j.cycle))
      result[j.vehicle].push_back({j.created, *t});
  return result;
}

/// Mean and deviation in ms, and how much is later than 50 ms.
struct latency_figures {
  std::size_t count = 0;
  double mean_ms = 0;
  double sd_ms = 0;
  double share_late = 0;
};

/// @returns the figures of `runs` runs with seeds of their own.
inline latency_figures latency_of(fleet f, unsigned runs) {
  latency_figures result;
  double sum = 0;
  double squares = 0;
  std::size_t late = 0;
  for (unsigned r = 0; r < runs; ++r, ++f.seed)
    for (const auto& vehicle : run(f))
      for (const auto& d : vehicle) {
        const auto ms = to_milliseconds(d.latency());
        ++result.count;
        sum += ms;
        squares += ms * ms;
        late += ms > 50;
      }
  const auto n = static_cast<double>(result.count);
  result.mean_ms = sum / n;
  result.sd_ms = std::sqrt(squares / n - result.mean_ms * result.mean_ms);
  result.share_late = static_cast<double>(late) / n;
  return result;
}

/// Offloading of one vehicle that stays in the area for a whole run: it begins
/// with an arrival, and ends with a gap over `longest_gap`, a latency over
/// 50 ms or the run; the next one may begin 1 s later.
/// @returns the durations, s.
inline std::vector<double>
offloading_durations_s(const std::vector<delivery>& arrivals,
                       duration longest_gap, time_point end) {
  using namespace std::chrono_literals;
  std::vector<double> durations;
  auto earliest = time_point::min();
  for (auto d = arrivals.begin(); d != arrivals.end();) {
    if (d->arrived < earliest || d->latency() > 50ms) {
      ++d;
      continue;
    }
    const auto begin = d->arrived;
    auto stop = end;
    for (auto last = begin; ++d != arrivals.end(); last = d->arrived) {
      const auto barks = last + longest_gap;
      const auto late = d->latency() > 50ms;
      if (d->arrived > barks || late) {
        stop = std::min({stop, barks, d->arrived});
        break;
      }
    }
    durations.push_back(to_seconds(stop - begin));
    earliest = stop + 1s;
  }
  return durations;
}

/// @returns the mean over `runs` runs and all vehicles, s.
inline double mean_offloading_s(fleet f, duration longest_gap, unsigned runs) {
  std::vector<double> all;
  for (unsigned r = 0; r < runs; ++r, ++f.seed)
    for (const auto& vehicle : run(f))
      for (const auto d :
           offloading_durations_s(vehicle, longest_gap, time_point{f.length}))
        all.push_back(d);
  return std::reduce(all.begin(), all.end()) / static_cast<double>(all.size());
}

} // namespace sofof::test
