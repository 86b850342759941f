// How much servers were asked for, bin by bin.
#include "channel/load_meter.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace sofof::channel {

load_figures::bin& load_figures::bin::operator+=(const bin& other) {
  jobs += other.jobs;
  asked += other.asked;
  waited += other.waited;
  busy += other.busy;
  return *this;
}

load_figures::bin load_figures::between(duration from, duration to) const {
  const auto after = [this](duration t) { // the first bin from then on
    const auto k = t > duration{0} ? (t - duration{1}) / width + 1 : 0;
    return std::min(static_cast<std::size_t>(k), bins.size());
  };
  bin sum;
  for (auto k = after(from); k < after(to); ++k)
    sum += bins[k];
  return sum;
}

load_meter::load_meter(unsigned servers, time_point start) : start_{start} {
  assert(servers >= 1);
  all_.servers = servers;
}

void load_meter::add(time_point arrives, duration wait, duration work) {
  assert(wait >= duration{0} && work >= duration{0});
  const std::lock_guard lock{mutex_};
  arrives = std::max(arrives, start_);
  auto& now = at(arrives);
  ++now.jobs;
  now.asked += work;
  now.waited += wait;
  all_.waits.add(wait);
  const auto end = arrives + wait + work;
  for (auto t = arrives + wait; t < end;) {
    const auto next =
        t + load_figures::width - (t - start_) % load_figures::width;
    const auto until = std::min(end, next);
    at(t).busy += until - t;
    t = until;
  }
}

load_figures load_meter::read() const {
  const std::lock_guard lock{mutex_};
  return all_;
}

load_figures::bin& load_meter::at(time_point t) {
  const auto k = static_cast<std::size_t>((t - start_) / load_figures::width);
  if (k >= all_.bins.size())
    all_.bins.resize(k + 1);
  return all_.bins[k];
}

} // namespace sofof::channel
