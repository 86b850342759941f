// How much servers were asked for, bin by bin.
#include "channel/load_meter.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

namespace sofof::channel {

load_figures::bin& load_figures::bin::operator+=(const bin& other) {
  jobs += other.jobs;
  asked += other.asked;
  waited += other.waited;
  busy += other.busy;
  return *this;
}

namespace {

/// @returns how many bins begin before then, of those that there are.
std::size_t bins_before(duration t, std::size_t there_are) {
  const auto k =
      t > duration{0} ? (t - duration{1}) / load_figures::width + 1 : 0;
  return std::min(static_cast<std::size_t>(k), there_are);
}

} // namespace

load_figures::bin load_figures::between(duration from, duration to) const {
  bin sum;
  for (auto k = bins_before(from, bins.size());
       k < bins_before(to, bins.size()); ++k)
    sum += bins[k];
  return sum;
}

duration load_figures::busy_for(std::string_view what, duration to) const {
  const auto found = busy_by.find(what);
  if (found == busy_by.end())
    return duration{0};
  const auto& busy = found->second;
  const auto end =
      busy.begin() + static_cast<std::ptrdiff_t>(bins_before(to, busy.size()));
  return std::accumulate(busy.begin(), end, duration{0});
}

load_meter::load_meter(unsigned servers, time_point start) : start_{start} {
  assert(servers >= 1);
  all_.servers = servers;
}

void load_meter::add(time_point arrives, duration wait, duration work,
                     std::string_view what) {
  assert(wait >= duration{0} && work >= duration{0});
  const std::lock_guard lock{mutex_};
  arrives = std::max(arrives, start_);
  auto& now = at(arrives);
  ++now.jobs;
  now.asked += work;
  now.waited += wait;
  all_.waits.add(wait);
  use(arrives + wait, arrives + wait + work, what);
}

void load_meter::use(time_point from, time_point until, std::string_view what) {
  std::vector<duration>* by = nullptr;
  if (!what.empty() && from < until) {
    auto found = all_.busy_by.find(what);
    if (found == all_.busy_by.end())
      found = all_.busy_by.emplace(what, std::vector<duration>{}).first;
    by = &found->second;
    by->resize(std::max(by->size(), number_of(until) + 1));
  }
  for (auto t = from; t < until;) {
    const auto next =
        t + load_figures::width - (t - start_) % load_figures::width;
    const auto used = std::min(until, next) - t;
    at(t).busy += used;
    if (by)
      (*by)[number_of(t)] += used;
    t += used;
  }
}

load_figures load_meter::read() const {
  const std::lock_guard lock{mutex_};
  return all_;
}

std::size_t load_meter::number_of(time_point t) const {
  return static_cast<std::size_t>((t - start_) / load_figures::width);
}

load_figures::bin& load_meter::at(time_point t) {
  const auto k = number_of(t);
  if (k >= all_.bins.size())
    all_.bins.resize(k + 1);
  return all_.bins[k];
}

} // namespace sofof::channel
