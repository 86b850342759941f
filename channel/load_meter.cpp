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
  longest_wait = std::max(longest_wait, other.longest_wait);
  busy += other.busy;
  return *this;
}

namespace {

/// Bins of the last minute are kept.
constexpr duration kept = std::chrono::minutes{1};
constexpr duration one_second = std::chrono::seconds{1};
constexpr auto bins_of_second =
    static_cast<std::size_t>(one_second / load_figures::width);

/// @returns how many of some pieces begin before then.
std::size_t begun_before(duration t, duration length, std::size_t there_are) {
  const auto k = t > duration{0} ? (t - duration{1}) / length + 1 : 0;
  return std::min(static_cast<std::size_t>(k), there_are);
}

std::size_t bins_before(duration t, std::size_t there_are) {
  return begun_before(t, load_figures::width, there_are);
}

} // namespace

load_figures::bin load_figures::between(duration from, duration to) const {
  bin sum;
  const auto& all = rows.sums();
  const auto end = begun_before(to, rows.length(), all.size());
  for (auto k = begun_before(from, rows.length(), all.size()); k < end; ++k)
    sum += all[k];
  for (auto k = bins_before(from - bins_from, bins.size());
       k < bins_before(to - bins_from, bins.size()); ++k)
    sum += bins[k];
  return sum;
}

bool load_figures::is_full(duration asked) const {
  return to_seconds(asked) > full_share * to_seconds(peak_length) * servers;
}

duration load_figures::busy_for(std::string_view what, duration to) const {
  const auto found = busy_by.find(what);
  if (found == busy_by.end())
    return duration{0};
  const auto& [before, busy] = found->second;
  const auto end = bins_before(to - bins_from, busy.size());
  return std::accumulate(
      busy.begin(), busy.begin() + static_cast<std::ptrdiff_t>(end), before);
}

load_meter::load_meter(unsigned servers, time_point start) : start_{start} {
  assert(servers >= 1);
  all_.servers = servers;
}

void load_meter::add(time_point arrives, duration wait, duration work,
                     std::string_view what) {
  assert(wait >= duration{0} && work >= duration{0});
  const std::lock_guard lock{mutex_};
  arrives = std::max(arrives, start_ + all_.bins_from);
  put_into_rows(arrives);
  auto& now = at(arrives);
  ++now.jobs;
  now.asked += work;
  now.waited += wait;
  now.longest_wait = std::max(now.longest_wait, wait);
  all_.waits.add(wait);
  use(arrives + wait, arrives + wait + work, what);
}

void load_meter::use(time_point from, time_point until, std::string_view what) {
  std::vector<duration>* by = nullptr;
  if (!what.empty() && from < until) {
    auto found = all_.busy_by.find(what);
    if (found == all_.busy_by.end())
      found = all_.busy_by.emplace(what, load_figures::use{}).first;
    by = &found->second.bins;
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

/// Moves what is longer ago than a minute out of the bins: nothing arrives in
/// them any more.
void load_meter::put_into_rows(time_point now) {
  while (now - start_ >= all_.bins_from + kept + one_second) {
    note_peaks();
    const auto of_second = [](auto& bins) {
      return bins.begin()
             + static_cast<std::ptrdiff_t>(
                 std::min(bins_of_second, bins.size()));
    };
    auto& bins = all_.bins;
    for (auto x = bins.begin(); x != of_second(bins); ++x)
      all_.rows.at(all_.bins_from) += *x;
    bins.erase(bins.begin(), of_second(bins));
    for (auto& [what, by] : all_.busy_by) {
      by.before =
          std::accumulate(by.bins.begin(), of_second(by.bins), by.before);
      by.bins.erase(by.bins.begin(), of_second(by.bins));
    }
    all_.bins_from += one_second;
  }
}

/// Of those that begin in the first second of the bins.
void load_meter::note_peaks() {
  constexpr auto bins_of_peak =
      static_cast<std::size_t>(load_figures::peak_length / load_figures::width);
  for (std::size_t k = 0; k < bins_of_second; ++k) {
    const auto from = all_.bins_from + k * load_figures::width;
    const auto asked = all_.between(from, from + all_.peak_length).asked;
    all_.most_asked = std::max(all_.most_asked, asked);
    if (k % bins_of_peak == 0 && all_.is_full(asked))
      all_.full += all_.peak_length;
  }
}

load_figures load_meter::read() const {
  const std::lock_guard lock{mutex_};
  return all_;
}

std::size_t load_meter::number_of(time_point t) const {
  return static_cast<std::size_t>((t - start_ - all_.bins_from)
                                  / load_figures::width);
}

load_figures::bin& load_meter::at(time_point t) {
  const auto k = number_of(t);
  if (k >= all_.bins.size())
    all_.bins.resize(k + 1);
  return all_.bins[k];
}

} // namespace sofof::channel
