// Drives past a provider, as simple as a learner can be taught by.
#pragma once

#include "policies/algorithms/forecast/normal_law.hpp"
#include "policies/api/context.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace sofof::test {

/// One vehicle that passes one provider on a straight street. Latencies are
/// lognormal, longer far away and where the provider is busy; the vehicle knows
/// their law. A late one takes the service home, and the provider is not asked
/// again for a second.
class toy_drive {
public:
  toy_drive(std::uint64_t seed, time_point begin)
      : random_{seed}, begin_{begin}, now_{begin}, since_{begin} {
    speed_mps_ = random_.between(4, 25);
    aside_m_ = random_.between(5, 120);
    utilisation_ = random_.between(0, 1.1);
    best_s_ = random_.between(0.008, 0.03);
    spread_ = random_.between(0.05, 0.5);
    energy_share_ = random_.between(0.15, 0.7);
  }

  /// @returns what it cost: energy in parts of that on board (0.3), missed
  /// cycles (1), and 0.2 for each change, in the mean over its half seconds.
  double cost(policies::local_policy& lodm) {
    auto steps = 0;
    cost_ = 0;
    for (x_m_ = -start_m; x_m_ < start_m; x_m_ += speed_mps_ * step_s) {
      offer(lodm);
      for (int k = 0; k < cycles; ++k)
        plan(lodm);
      now_ += from_seconds(step_s);
      ++steps;
    }
    end(lodm, "left_area");
    return cost_ / steps;
  }

private:
  static constexpr double start_m = 320;
  static constexpr double step_s = 0.5;
  static constexpr int cycles = 10;
  static constexpr double on_board_j = 0.027;

  double distance_from_provider_m() const { return std::hypot(x_m_, aside_m_); }
  double median_s() const {
    const auto wait = 1 + std::max(utilisation_ - 0.5, 0.0);
    const auto far = distance_from_provider_m() / 300;
    return best_s_ * wait * (1 + 0.5 * far * far);
  }
  double late() const { return chance_above(std::log(0.05)); }
  double chance_above(double log_s) const {
    return 1 - policies::normal_cdf((log_s - std::log(median_s())) / spread_);
  }

  policies::provider_view provider() const {
    policies::provider_view seen{
        .id = 7, .at = {0, 0}, .utilisation = utilisation_};
    seen.computing_s = 0.008;
    seen.cost = {0.012, energy_share_ * on_board_j};
    if (now_ - begin_ < std::chrono::seconds{1})
      return seen; // too little came
    const auto p99_s = median_s() * std::exp(2.326 * spread_);
    seen.link = {late(), late() / 10, from_seconds(median_s()),
                 from_seconds(p99_s)};
    return seen;
  }

  void offer(policies::local_policy& lodm) {
    if (distance_from_provider_m() > 300)
      end(lodm, "left_area");
    if (now_ < cool_until_ || distance_from_provider_m() > 300)
      return;
    std::vector<point> path;
    for (auto x = x_m_; x < x_m_ + 800; x += 5)
      path.push_back({x, aside_m_});
    const std::array all{provider()};
    policies::local_context context{now_, "any", all, path, speed_mps_};
    context.number = ++decisions_;
    context.current = current_;
    context.since = since_;
    using namespace std::chrono_literals;
    context.needs = {50ms, 50ms, 100ms};
    context.on_board = {0.01, on_board_j};
    const auto decision = lodm.decide(context);
    if (comes_home(decision))
      end(lodm, "released");
    else if (const auto to = after(decision, current_); to != current_)
      change(to);
  }

  void plan(policies::local_policy& lodm) {
    policies::cycle_outcome outcome{now_, "any", current_,
                                    0.01, false, on_board_j};
    if (current_) {
      outcome.energy_j *= energy_share_;
      outcome.missed = random_.between(0, 1) < late();
      outcome.latency_s = outcome.missed ? 0.06 : median_s();
    }
    cost_ += (0.3 * outcome.energy_j / on_board_j + (outcome.missed ? 1 : 0))
             / cycles;
    lodm.observe(outcome);
    if (!outcome.missed)
      return;
    end(lodm, "qos_latency");
    cool_until_ = now_ + std::chrono::seconds{1};
  }

  void end(policies::local_policy& lodm, std::string_view reason) {
    if (!current_)
      return;
    change(std::nullopt);
    lodm.observe(policies::episode_outcome{"any", 7, 1, reason});
  }

  void change(service_place to) {
    current_ = to;
    since_ = now_;
    cost_ += 0.2;
  }

  dice random_;
  time_point begin_;
  double speed_mps_;
  double aside_m_;
  double utilisation_;
  double best_s_;
  double spread_;
  double energy_share_;
  double x_m_ = 0;
  double cost_ = 0;
  time_point now_;
  time_point since_;
  time_point cool_until_;
  service_place current_;
  std::uint64_t decisions_ = 0;
};

/// @returns what drives with these seeds, one an hour, cost in the mean.
inline double mean_cost(policies::local_policy& lodm, std::uint64_t first,
                        int drives) {
  double sum = 0;
  for (int k = 0; k < drives; ++k) {
    const auto seed = first + static_cast<std::uint64_t>(k);
    const auto begin = time_point{std::chrono::hours{seed}};
    sum += toy_drive{seed, begin}.cost(lodm);
  }
  return sum / drives;
}

} // namespace sofof::test
