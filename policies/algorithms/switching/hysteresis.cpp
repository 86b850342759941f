// Keeps a scorer from switching to and fro.
#include "policies/algorithms/switching/hysteresis.hpp"

#include <cassert>

namespace sofof::policies {

service_place hysteresis::next(const wish& wanted, time_point now) {
  assert(!better_since_ || now >= *better_since_);
  if (wanted.must_fall_back) {
    better_since_.reset();
    if (source_)
      switch_to(std::nullopt, now);
    return source_;
  }
  if (wanted.source == source_ || !(wanted.advantage > options_.margin)) {
    better_since_.reset();
    return source_;
  }
  if (!better_since_ || wanted.source != challenger_) {
    challenger_ = wanted.source;
    better_since_ = now;
  }
  const auto triggered = now - *better_since_ >= options_.time_to_trigger;
  const auto dwelt = !switched_ || now - *switched_ >= options_.dwell;
  if (triggered && dwelt)
    switch_to(wanted.source, now);
  return source_;
}

void hysteresis::switch_to(service_place source, time_point now) {
  source_ = source;
  switched_ = now;
  better_since_.reset();
}

} // namespace sofof::policies
