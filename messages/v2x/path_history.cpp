// Where a vehicle has been, in few points.
#include "messages/v2x/path_history.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace sofof::messages {
namespace {

/// Source: CAR 2 CAR Basic System Profile, pTraceAllowableError and
/// pTraceMaxDeltaDistance; SAE J2945/1, vMinPHistDistance.
constexpr double allowed_error_m = 0.47;
constexpr double longest_chord_m = 22.5;
constexpr double enough_m = 200;

/// Places nearer to each other tell nothing, such as a standing car's.
constexpr double least_way_m = 1;

} // namespace

path_history::path_history(std::size_t most)
    : most_{std::clamp<std::size_t>(most, 1, capacity)} {}

void path_history::pass(time_point now, point position) {
  if (!std::isfinite(position.x_m) || !std::isfinite(position.y_m))
    return;
  const place here{position, now};
  if (size_ == 0) {
    keep(here);
    return;
  }
  const auto& before =
      since_size_ == 0 ? kept_[newest_] : since_[since_size_ - 1];
  if (distance_m(before.at, position) < least_way_m)
    return;
  if (since_size_ == since_.size() || (since_size_ > 0 && is_needed(position)))
    keep(since_[since_size_ - 1]);
  since_[since_size_++] = here;
}

/// Whether the way on to `next` needs a point between: the place before it.
bool path_history::is_needed(point next) const {
  const auto from = kept_[newest_].at;
  return distance_m(from, next) > longest_chord_m
         || std::ranges::any_of(
             std::span{since_}.first(since_size_), [&](const place& x) {
               return distance_to_segment_m(x.at, from, next) > allowed_error_m;
             });
}

void path_history::keep(const place& x) {
  newest_ = (newest_ + 1) % capacity;
  kept_[newest_] = x;
  size_ = std::min(size_ + 1, most_);
  since_size_ = 0;
  drop_what_is_far();
}

void path_history::drop_what_is_far() {
  auto way_m = 0.0;
  for (std::size_t i = 1; i < size_; ++i) {
    way_m += distance_m((*this)[i - 1].at, (*this)[i].at);
    if (way_m >= enough_m) {
      size_ = i + 1;
      return;
    }
  }
}

} // namespace sofof::messages
