// How far the clock of another host is ahead of ours.
#include "network/flow/clock_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace sofof::network {

namespace {

using namespace std::chrono_literals;

constexpr duration longest_round_trip = 10s;
constexpr duration longest_lateness = 10s;
constexpr duration slot_length = 1s;
constexpr std::size_t slots_in_use = 8; // for the offset; all for the drift

// Contradictions that make a step, and the time that they may take.
constexpr auto enough_contradictions = 5;
constexpr duration longest_contradiction = 2s;

// Quartz is good for some 50 ppm; two clocks, and some for heat and age.
constexpr double largest_drift = 200e-6;
constexpr double usual_drift = 100e-6; // standard deviation
// Standard deviation of the offset of a slot without any visible delay.
constexpr double least_noise_s = 250e-6;

/// @returns by how much an offset may have changed meanwhile.
duration largest_change(duration age) {
  return std::chrono::abs(age) / 5000 + duration{1};
}
static_assert(largest_drift * 5000 == 1);

/// @returns the change of an offset at a steady drift.
duration change(double drift, duration age) {
  return duration{std::llround(drift * static_cast<double>(age.count()))};
}

bool is_possible(const clock_exchange& e) {
  if (!is_plausible(e.asked) || !is_plausible(e.heard)
      || !is_plausible(e.answered) || !is_plausible(e.received))
    return false;
  const auto ours = e.received - e.asked;
  const auto theirs = e.answered - e.heard;
  return ours >= 0s && theirs >= 0s && ours <= longest_round_trip
         && theirs <= ours + largest_change(ours);
}

} // namespace

void clock_estimate::add(const clock_exchange& exchange) {
  if (!is_possible(exchange))
    return;
  const auto told = told_by(exchange);
  if (believable(told))
    keep(told);
  else
    suspect(told);
}

std::optional<clock_offset> clock_estimate::at(time_point now) const {
  if (opened_ == 0 || !is_plausible(now))
    return std::nullopt;
  auto least = duration::min(); // for certain
  auto most = duration::max();
  auto low = duration::min(); // if the drift is as fitted
  auto high = duration::max();
  for (auto n = oldest(slots_in_use); n < opened_; ++n) {
    const auto& [begin, lower, upper] = slot(n);
    const auto since_lower = now - lower.at;
    const auto since_upper = now - upper.at;
    least = std::max(least, lower.ahead - largest_change(since_lower));
    most = std::min(most, upper.ahead + largest_change(since_upper));
    low = std::max(low, lower.ahead + change(drift_, since_lower));
    high = std::min(high, upper.ahead + change(drift_, since_upper));
  }
  const auto ahead = std::clamp(low + (high - low) / 2, least, most);
  return clock_offset{ahead, std::max(ahead - least, most - ahead)};
}

/// Whatever the delays were, their clock showed `heard` not before we asked,
/// and `answered` not after we received.
clock_estimate::limits clock_estimate::told_by(const clock_exchange& exchange) {
  const auto meanwhile = largest_change(exchange.received - exchange.asked);
  const auto at = exchange.received;
  return {at,
          {at, exchange.answered - exchange.received - meanwhile},
          {at, exchange.heard - exchange.asked + meanwhile}};
}

void clock_estimate::narrow(limits& known, const limits& told) {
  if (told.least.ahead > known.least.ahead)
    known.least = told.least;
  if (told.most.ahead < known.most.ahead)
    known.most = told.most;
}

bool clock_estimate::agree(const limits& one, const limits& other) {
  const auto below = [](const limit& least, const limit& most) {
    return least.ahead <= most.ahead + largest_change(least.at - most.at);
  };
  return below(one.least, other.most) && below(other.least, one.most);
}

/// @returns the oldest of the last `number` slots.
std::size_t clock_estimate::oldest(std::size_t number) const {
  return opened_ - std::min(opened_, number);
}

bool clock_estimate::believable(const limits& told) const {
  if (opened_ == 0)
    return true;
  if (slot(opened_ - 1).begin - told.begin > longest_lateness)
    return false; // our own clock went back
  for (auto n = oldest(slots_in_use); n < opened_; ++n)
    if (!agree(slot(n), told))
      return false;
  return true;
}

void clock_estimate::keep(const limits& told) {
  if (opened_ == 0 || told.begin - slot(opened_ - 1).begin >= slot_length) {
    drift_ = fitted_drift();
    slot(opened_++) = told;
    return;
  }
  auto n = opened_ - 1;
  while (n > oldest(slots_kept) && told.begin < slot(n).begin)
    --n;
  narrow(slot(n), told);
}

void clock_estimate::suspect(const limits& told) {
  const auto since = std::chrono::abs(told.begin - other_.begin);
  const auto again = contradictions_ > 0 && since <= longest_contradiction
                     && agree(other_, told);
  if (!again) {
    other_ = told;
    contradictions_ = 1;
    return;
  }
  narrow(other_, told);
  if (++contradictions_ < enough_contradictions)
    return;
  contradictions_ = 0;
  ++steps_;
  opened_ = 0;
  drift_ = 0;
  keep(other_);
}

/// Weighted least squares through the middles of the slots, with a prior of no
/// drift. A slot is worth the more the closer its limits are.
double clock_estimate::fitted_drift() const {
  const auto first = oldest(slots_kept);
  if (opened_ - first < 2)
    return 0;
  auto narrowest = duration::max();
  for (auto n = first; n < opened_; ++n)
    narrowest = std::min(narrowest, slot(n).most.ahead - slot(n).least.ahead);
  const auto& origin = slot(first).least;
  double weights = 0;
  double sum_t = 0;
  double sum_y = 0;
  double sum_tt = 0;
  double sum_ty = 0;
  for (auto n = first; n < opened_; ++n) {
    const auto& [begin, lower, upper] = slot(n);
    const auto t_s =
        (to_seconds(lower.at - origin.at) + to_seconds(upper.at - origin.at))
        / 2;
    const auto y_s = (to_seconds(lower.ahead - origin.ahead)
                      + to_seconds(upper.ahead - origin.ahead))
                     / 2;
    // The middle lies anywhere within what the limits are wider than need be.
    const auto slack_s = to_seconds(upper.ahead - lower.ahead - narrowest);
    const auto weight =
        1 / (least_noise_s * least_noise_s + slack_s * slack_s / 12);
    weights += weight;
    sum_t += weight * t_s;
    sum_y += weight * y_s;
    sum_tt += weight * t_s * t_s;
    sum_ty += weight * t_s * y_s;
  }
  // Rounding must not make a spread negative.
  const auto about_t = std::max(sum_tt - sum_t * sum_t / weights, 0.0);
  const auto about_y = sum_ty - sum_t * sum_y / weights;
  const auto drift = about_y / (about_t + 1 / (usual_drift * usual_drift));
  return std::clamp(drift, -largest_drift, largest_drift);
}

} // namespace sofof::network
