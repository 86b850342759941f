// Jobs are computed up to now whenever anybody asks.
#include "channel/preemptive_core.hpp"

#include <algorithm>
#include <cassert>
#include <optional>

namespace sofof::channel {

void preemptive_core::begin(std::size_t function, time_point now, duration work,
                            time_point due) {
  assert(work >= duration{0});
  compute_until(now);
  auto& its = jobs_.at(function);
  assert(!its.is_under_way);
  its = {true, work, due, {}};
}

time_point preemptive_core::done_at(std::size_t function, time_point now) {
  compute_until(now);
  const auto& its = jobs_.at(function);
  if (!its.is_under_way)
    return its.done;
  auto done = now_ + its.left;
  for (std::size_t k = 0; k < jobs_.size(); ++k)
    if (jobs_[k].is_under_way && is_before(k, function))
      done += jobs_[k].left;
  return done;
}

bool preemptive_core::is_under_way(std::size_t function, time_point now) {
  compute_until(now);
  return jobs_.at(function).is_under_way;
}

void preemptive_core::compute_until(time_point now) {
  assert(now >= now_);
  for (;;) {
    std::optional<std::size_t> first;
    for (std::size_t k = 0; k < jobs_.size(); ++k)
      if (jobs_[k].is_under_way && (!first || is_before(k, *first)))
        first = k;
    if (!first) {
      now_ = now;
      return;
    }
    auto& its = jobs_[*first];
    const auto step = std::min(its.left, now - now_);
    its.left -= step;
    now_ += step;
    if (its.left > duration{0})
      return;
    its.is_under_way = false;
    its.done = now_;
  }
}

bool preemptive_core::is_before(std::size_t a, std::size_t b) const {
  if (order_ == core_order::edf && jobs_[a].due != jobs_[b].due)
    return jobs_[a].due < jobs_[b].due;
  return a < b;
}

} // namespace sofof::channel
