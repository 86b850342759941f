// Distributions of durations, drawn by number.
#include "channel/delay_distribution.hpp"

#include "channel/draw_lanes.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof::channel {

delay_distribution delay_distribution::uniform(duration low, duration high) {
  return {shape::uniform, low, to_seconds(high - low)};
}

delay_distribution delay_distribution::exponential(duration mean) {
  return {shape::exponential, {}, to_seconds(mean)};
}

delay_distribution delay_distribution::lognormal(duration shift, duration mean,
                                                 duration sd) {
  assert(mean > duration{0});
  const auto spread = to_seconds(sd) / to_seconds(mean);
  const auto variance = std::log1p(spread * spread);
  return {shape::lognormal, shift, std::log(to_seconds(mean)) - variance / 2,
          std::sqrt(variance)};
}

delay_distribution delay_distribution::lognormal_about(duration shift,
                                                       duration scale,
                                                       double sigma) {
  assert(scale > duration{0});
  return {shape::lognormal, shift, std::log(to_seconds(scale)), sigma};
}

delay_distribution delay_distribution::beta(duration longest, double a,
                                            double b) {
  return {shape::beta, {}, to_seconds(longest), a, b};
}

delay_distribution delay_distribution::kept(double probability) const {
  assert(probability >= 0 && probability < 1);
  auto law = *this;
  law.kept_ = probability;
  return law;
}

double delay_distribution::draw_some_s(const random_stream& stream,
                                       std::uint64_t number,
                                       std::uint32_t lane) const {
  while (kept_ > 0 && number > 0
         && stream.uniform(number, renewal_lane) < kept_)
    --number;
  switch (kind_) {
    case shape::none:
      return 0;
    case shape::uniform:
      return shift_s_ + p_ * stream.uniform(number, lane);
    case shape::exponential:
      return shift_s_ + stream.exponential(p_, number, lane);
    case shape::lognormal:
      return shift_s_ + std::exp(stream.normal(p_, q_, number, lane));
    case shape::beta:
      return shift_s_ + p_ * stream.beta(q_, r_, number, lane);
  }
  return 0;
}

double delay_distribution::mean_s() const {
  switch (kind_) {
    case shape::none:
      return 0;
    case shape::uniform:
      return shift_s_ + p_ / 2;
    case shape::exponential:
      return shift_s_ + p_;
    case shape::lognormal:
      return shift_s_ + std::exp(p_ + q_ * q_ / 2);
    case shape::beta:
      return shift_s_ + p_ * q_ / (q_ + r_);
  }
  return 0;
}

draw_bound delay_distribution::bound() const {
  constexpr double deviations = 4.264890793922825; // P(Z > this) = `rare`
  const auto normal_tail = [](double z) {
    return std::erfc(z / std::numbers::sqrt2) / 2;
  };
  switch (kind_) {
    case shape::none:
      return {};
    case shape::uniform:
    case shape::beta:
      return {shift_s_ + p_};
    case shape::exponential:
      return {shift_s_ - p_ * std::log(rare), rare, p_ * rare};
    case shape::lognormal: {
      const auto above_s = std::exp(p_ + q_ * deviations);
      // As an option is priced: E[X; X > a] − a P(X > a).
      return {shift_s_ + above_s, rare,
              std::exp(p_ + q_ * q_ / 2) * normal_tail(deviations - q_)
                  - above_s * rare};
    }
  }
  return {};
}

double delay_distribution::deviation_s() const {
  switch (kind_) {
    case shape::none:
      return 0;
    case shape::uniform:
      return p_ / std::sqrt(12.0);
    case shape::exponential:
      return p_;
    case shape::lognormal:
      return std::exp(p_ + q_ * q_ / 2) * std::sqrt(std::expm1(q_ * q_));
    case shape::beta:
      return p_ / (q_ + r_) * std::sqrt(q_ * r_ / (q_ + r_ + 1));
  }
  return 0;
}

} // namespace sofof::channel
