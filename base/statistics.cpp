// Statistics of a stream, number by number.
#include "base/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof {

void statistics::add(double x) {
  max_ = count_ == 0 ? x : std::max(max_, x);
  ++count_;
  const auto before = x - mean_;
  mean_ += before / static_cast<double>(count_);
  squares_ += before * (x - mean_);
}

std::optional<double> statistics::mean() const {
  return count_ > 0 ? std::optional{mean_} : std::nullopt;
}

std::optional<double> statistics::deviation() const {
  if (count_ < 2)
    return std::nullopt;
  return std::sqrt(squares_ / static_cast<double>(count_ - 1));
}

std::optional<double> statistics::max() const {
  return count_ > 0 ? std::optional{max_} : std::nullopt;
}

void distribution::add(duration d) {
  ms_.add(to_milliseconds(d));
  if (d > span_)
    return;
  const auto positive = std::max(d, duration::zero());
  const auto bin = static_cast<std::size_t>(
      (positive + resolution_ - duration{1}) / resolution_);
  if (bin >= bins_.size())
    bins_.resize(bin + 1);
  ++bins_[bin];
}

std::optional<double> distribution::quantile_ms(double p) const {
  assert(p > 0 && p <= 1);
  if (ms_.count() == 0)
    return std::nullopt;
  const auto wanted = p * static_cast<double>(ms_.count());
  std::uint64_t seen = 0;
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    seen += bins_[k];
    if (static_cast<double>(seen) >= wanted)
      return std::min(static_cast<double>(k) * to_milliseconds(resolution_),
                      *ms_.max());
  }
  return ms_.max();
}

std::vector<distribution::bin> distribution::bins(duration width) const {
  assert(width > duration{0} && width % resolution_ == duration{0});
  const auto fine = static_cast<std::size_t>(width / resolution_);
  std::vector<bin> coarse;
  std::uint64_t within = 0;
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    if (bins_[k] == 0)
      continue;
    within += bins_[k];
    const auto number = (k + fine - 1) / fine;
    const auto up_to_ms = static_cast<double>(number) * to_milliseconds(width);
    if (coarse.empty() || coarse.back().up_to_ms < up_to_ms)
      coarse.push_back({up_to_ms, 0});
    coarse.back().count += bins_[k];
  }
  if (within < ms_.count())
    coarse.push_back({*ms_.max(), ms_.count() - within});
  return coarse;
}

} // namespace sofof
