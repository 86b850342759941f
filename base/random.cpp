// A hash of (key, counter, lane) instead of a generator with a state.
#include "base/random.hpp"

#include "base/fingerprint.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace sofof {

namespace {

// 2^64 divided by the golden ratio, and two more odd words without pattern.
constexpr std::uint64_t counter_step = 0x9e3779b97f4a7c15;
constexpr std::uint64_t lane_step = 0xd1342543de82ef95;
constexpr std::uint64_t part_mark = 0x2545f4914f6cdd1d;

// Flips every output bit with probability 1/2 when an input bit flips: the
// output function of SplitMix64 (Steele, Lea & Flood 2014, with the constants
// of D. Stafford's "variant 13").
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// The bits of one (counter, lane): as many words as a draw asks for.
class words {
public:
  words(std::uint64_t key, std::uint64_t counter, std::uint32_t lane)
      : key_{key}, place_{counter * counter_step + lane * lane_step} {}

  std::uint64_t next() {
    const auto word = mix(key_ ^ mix(place_));
    place_ += lane_step << 32;
    return word;
  }

  // The middles of 2^52 equal cells: symmetric, and never 0 or 1.
  double uniform() {
    return (static_cast<double>(next() >> 12) + 0.5) * 0x1p-52;
  }

  // Box & Muller 1958.
  double normal() {
    const auto radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

  // Marsaglia & Tsang 2000; accepts at least 95 % of its tries.
  double gamma(double shape) {
    if (shape < 1) {
      const auto shrink = std::pow(uniform(), 1 / shape);
      return shrink * gamma(shape + 1);
    }
    const auto d = shape - 1.0 / 3;
    const auto c = 1 / std::sqrt(9 * d);
    for (;;) {
      const auto x = normal();
      const auto u = uniform();
      const auto root = 1 + c * x;
      const auto v = root * root * root;
      if (v > 0 && std::log(u) < 0.5 * x * x + d * (1 - v + std::log(v)))
        return d * v;
    }
  }

private:
  std::uint64_t key_;
  std::uint64_t place_;
};

} // namespace

random_stream::random_stream(std::uint64_t seed, std::string_view name)
    : key_{mix(mix(seed + counter_step) ^ fingerprint(name))} {}

random_stream random_stream::part(std::string_view name) const {
  return part(fingerprint(name));
}

random_stream random_stream::part(std::uint64_t number) const {
  return random_stream{mix(key_ ^ mix(number ^ part_mark))};
}

std::uint64_t random_stream::bits(std::uint64_t counter,
                                  std::uint32_t lane) const {
  return words{key_, counter, lane}.next();
}

double random_stream::uniform(std::uint64_t counter, std::uint32_t lane) const {
  return words{key_, counter, lane}.uniform();
}

double random_stream::uniform(double low, double high, std::uint64_t counter,
                              std::uint32_t lane) const {
  return low + (high - low) * uniform(counter, lane);
}

double random_stream::normal(double mean, double sd, std::uint64_t counter,
                             std::uint32_t lane) const {
  return mean + sd * words{key_, counter, lane}.normal();
}

double random_stream::exponential(double mean, std::uint64_t counter,
                                  std::uint32_t lane) const {
  return -mean * std::log(uniform(counter, lane));
}

double random_stream::lognormal(double mean, double sd, std::uint64_t counter,
                                std::uint32_t lane) const {
  assert(mean > 0);
  const auto spread = sd / mean;
  const auto variance = std::log1p(spread * spread);
  return std::exp(normal(std::log(mean) - 0.5 * variance, std::sqrt(variance),
                         counter, lane));
}

double random_stream::beta(double a, double b, std::uint64_t counter,
                           std::uint32_t lane) const {
  assert(a >= 0.05 && b >= 0.05);
  words w{key_, counter, lane};
  const auto x = w.gamma(a);
  return x / (x + w.gamma(b));
}

} // namespace sofof
