// The radio cell in which Chen 2016 plays the offloading game.
#pragma once

#include "base/random.hpp"
#include "policies/algorithms/game/offloading_game.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sofof::test {

// Section VII of the paper has all of it but three things. How much energy a
// cycle takes is not given: cycles per joule are those of a public program for
// a sequel (Zheng et al., TMC 18(4), 2019). Nor is tail energy: none here.
// Users are "randomly scattered": their distance is uniform here, which fits
// the figures better than a uniform density, and at least 1 m, below which
// the path loss would be a gain.
struct radio_cell {
  static constexpr double nearest_m = 1;
  static constexpr double radius_m = 50;
  static constexpr std::size_t channels = 5;
  static constexpr double bandwidth_hz = 5e6;
  static constexpr double transmit_power_w = 0.1;
  static constexpr double noise_w = 1e-13; // -100 dBm
  static constexpr double path_loss_exponent = 4;
  static constexpr double bits = 5000e3 * 8; // 5000 KB
  static constexpr double cycles = 1e9;
  static constexpr std::array local_clocks_hz{0.5e9, 0.8e9, 1.0e9};
  static constexpr double cloud_clock_hz = 10e9;
  static constexpr std::array energy_weights{1.0, 0.5, 0.0};
  static constexpr std::array cycles_per_joule{400e6, 500e6, 600e6};
};

/// One of three values, each as likely.
inline double one_of(const std::array<double, 3>& values,
                     const random_stream& stream, std::uint64_t counter,
                     std::uint32_t lane) {
  return values[static_cast<std::size_t>(stream.uniform(counter, lane) * 3)];
}

/// The users of a cell; the first ones are the same however many there are.
inline std::vector<policies::game::player> users(std::size_t count,
                                                 std::uint64_t seed) {
  enum lane : std::uint32_t { distance, clock, weight, efficiency };
  using cell = radio_cell;
  const random_stream stream{seed, "radio cell"};
  std::vector<policies::game::player> all(count);
  for (std::size_t n = 0; n < count; ++n) {
    auto& p = all[n];
    p.cycles = cell::cycles;
    p.bits = cell::bits;
    p.local_clock_hz = one_of(cell::local_clocks_hz, stream, n, clock);
    p.cloud_clock_hz = cell::cloud_clock_hz;
    p.energy_per_cycle_j =
        1 / one_of(cell::cycles_per_joule, stream, n, efficiency);
    p.transmit_power_w = cell::transmit_power_w;
    p.energy_weight = one_of(cell::energy_weights, stream, n, weight);
    p.time_weight = 1 - p.energy_weight;
    const auto distance_m =
        stream.uniform(cell::nearest_m, cell::radius_m, n, distance);
    p.received_power_w = cell::transmit_power_w
                         * std::pow(distance_m, -cell::path_loss_exponent);
    p.lone_rate_bps =
        cell::bandwidth_hz * std::log2(1 + p.received_power_w / cell::noise_w);
  }
  return all;
}

inline std::shared_ptr<const policies::game::channel_model> taking_turns() {
  return std::make_shared<policies::game::contention>();
}

inline std::shared_ptr<const policies::game::channel_model> all_at_once() {
  return std::make_shared<policies::game::interference>(
      radio_cell::bandwidth_hz, radio_cell::noise_w);
}

/// Everybody offloads, each over a channel drawn blindly.
inline policies::game::profile
blindly_offloaded(const policies::game::offloading_game& game,
                  std::uint64_t seed) {
  const random_stream stream{seed, "channels"};
  const auto channels = static_cast<double>(game.channels());
  auto choices = game.all_local();
  for (std::size_t n = 0; n < choices.size(); ++n)
    choices[n] =
        1 + static_cast<policies::game::choice>(stream.uniform(n) * channels);
  return choices;
}

} // namespace sofof::test
