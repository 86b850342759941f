// Tests of the offloading game: what theory promises of it.
// Source: Chen, Jiao, Li & Fu, ToN 24(5), 2016.
#include "policies/algorithms/game/best_response.hpp"
#include "tests/support/game_laws.hpp"
#include "tests/support/radio_cell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <vector>

namespace sofof::policies::game {

using namespace test;

namespace {

constexpr std::uint64_t seeds = 20;
constexpr auto infinity = std::numeric_limits<double>::infinity();

using model_ptr = std::shared_ptr<const channel_model>;

const std::vector<model_ptr>& both_models() {
  static const std::vector<model_ptr> models{taking_turns(), all_at_once()};
  return models;
}

offloading_game cell_game(std::uint64_t seed, const model_ptr& model) {
  return {users(30, seed), radio_cell::channels, model};
}

random_stream lottery(std::uint64_t seed) {
  return {seed, "lottery"};
}

// Games of both models, each begun locally and from the crowd.
template <class Check>
void for_each_start(Check check) {
  for (const auto& model : both_models())
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const auto game = cell_game(seed, model);
      check(game, game.all_local(), seed);
      check(game, blindly_offloaded(game, seed), seed);
    }
}

// Every profile of a small game, one after the other.
template <class Visit>
void for_each_profile(const offloading_game& game, Visit visit) {
  auto a = game.all_local();
  for (;;) {
    visit(a);
    std::size_t n = 0;
    while (n < a.size() && a[n] == game.channels())
      a[n++] = locally;
    if (n == a.size())
      return;
    ++a[n];
  }
}

std::size_t offloaders(const profile& a) {
  return a.size()
         - static_cast<std::size_t>(std::count(a.begin(), a.end(), locally));
}

struct optimum {
  double least_cost = infinity;
  std::size_t most_users = 0; // who all gain
};

optimum brute_force(const offloading_game& game) {
  optimum best;
  for_each_profile(game, [&](const profile& a) {
    best.least_cost = std::min(best.least_cost, total_cost(game, a));
    const auto offloading = offloaders(a);
    if (offloading > best.most_users && beneficial_users(game, a) == offloading)
      best.most_users = offloading;
  });
  return best;
}

// Theorem 5's bounds: sums of what each player pays at most at an
// equilibrium, and at least anywhere.
struct cost_range {
  double most = 0;
  double least = 0;
};

cost_range costs_in_theory(const offloading_game& game) {
  const auto& model = game.model();
  double all = 0;
  for (const auto& p : game.players())
    all += model.weight(p);
  cost_range sums;
  for (const auto& p : game.players()) {
    const auto others =
        (all - model.weight(p)) / static_cast<double>(game.channels());
    const auto at_best = offloading_cost(p, model.rate_bps(p, 0));
    const auto crowded = offloading_cost(p, model.rate_bps(p, others));
    sums.most += std::min(local_cost(p), crowded);
    sums.least += std::min(local_cost(p), at_best);
  }
  return sums;
}

// Theorem 4's bound; nullopt where somebody's threshold is negative.
std::optional<double> least_share_of_users(const offloading_game& game) {
  auto least_threshold = infinity;
  auto most_threshold = 0.0;
  auto least_weight = infinity;
  auto most_weight = 0.0;
  for (std::size_t n = 0; n < game.players().size(); ++n) {
    const auto weight = game.model().weight(game.players()[n]);
    least_threshold = std::min(least_threshold, game.threshold(n));
    most_threshold = std::max(most_threshold, game.threshold(n));
    least_weight = std::min(least_weight, weight);
    most_weight = std::max(most_weight, weight);
  }
  if (least_threshold < 0)
    return std::nullopt;
  return std::floor(least_threshold / most_weight)
         / (std::floor(most_threshold / least_weight) + 1);
}

// Two seconds or two joules locally; a tenth of a second in the cloud.
player plain_player() {
  player p;
  p.cycles = 1e9;
  p.bits = 40e6;
  p.local_clock_hz = 0.5e9;
  p.cloud_clock_hz = 10e9;
  p.energy_per_cycle_j = 2e-9;
  p.transmit_power_w = 0.1;
  p.time_weight = 1;
  p.received_power_w = 1e-8;
  p.lone_rate_bps = 100e6;
  return p;
}

} // namespace

TEST_CASE("computing locally costs time and energy as they are weighed") {
  auto p = plain_player();
  CHECK(local_cost(p) == doctest::Approx(2));
  p.time_weight = 0.25;
  p.energy_weight = 0.75;
  p.energy_per_cycle_j = 4e-9;
  CHECK(local_cost(p) == doctest::Approx(0.25 * 2 + 0.75 * 4));
}

TEST_CASE("offloading costs sending, the cloud's time and the tail energy") {
  auto p = plain_player();
  CHECK(offloading_cost(p, 20e6) == doctest::Approx(2 + 0.1));
  p.time_weight = 0.25;
  p.energy_weight = 0.75;
  p.tail_energy_j = 0.5;
  CHECK(offloading_cost(p, 20e6)
        == doctest::Approx(0.25 * 2.1 + 0.75 * (0.2 + 0.5)));
  CHECK(offloading_cost(p, 0) == infinity);
}

TEST_CASE("at its beneficial rate offloading costs what computing here does") {
  const auto p = plain_player();
  CHECK(beneficial_rate_bps(p) == doctest::Approx(40e6 / 1.9));
}

TEST_CASE("who takes turns with equals shares the rate with them") {
  const contention model;
  const auto p = plain_player();
  CHECK(model.rate_bps(p, 0) == doctest::Approx(100e6));
  CHECK(model.rate_bps(p, 3) == doctest::Approx(25e6));
}

TEST_CASE("who is as loud as the others together sends a bit per hertz") {
  const interference model{5e6, 1e-13};
  const auto p = plain_player();
  CHECK(model.rate_bps(p, 1e-8 - 1e-13) == doctest::Approx(5e6));
}

TEST_CASE("at its threshold a player does not care") {
  for_each_start([](const offloading_game& game, const profile&, auto) {
    for (std::size_t n = 0; n < game.players().size(); ++n) {
      if (game.threshold(n) < 0)
        continue;
      const auto& p = game.players()[n];
      const auto rate_bps = game.model().rate_bps(p, game.threshold(n));
      REQUIRE(offloading_cost(p, rate_bps) == doctest::Approx(local_cost(p)));
    }
  });
}

TEST_CASE("who would pay more in the cloud than here never offloads") {
  auto slow_cloud = plain_player();
  slow_cloud.cloud_clock_hz = 0.4e9;
  CHECK(beneficial_rate_bps(slow_cloud) == infinity);
  for (const auto& model : both_models()) {
    const offloading_game game{{slow_cloud}, 3, model};
    CHECK(game.threshold(0) < 0);
    CHECK(play(game, {2}, std::nullopt).choices == profile{locally});
  }
}

TEST_CASE("two players who could share a channel take two") {
  for (const auto& model : both_models()) {
    const offloading_game game{{plain_player(), plain_player()}, 2, model};
    const auto found = play(game, game.all_local(), std::nullopt);
    CHECK(found.choices == profile{1, 2});
    CHECK(found.slots == 2);
  }
}

TEST_CASE("without a lottery the first who asks moves") {
  const offloading_game game{
      {plain_player(), plain_player(), plain_player()}, 2, taking_turns()};
  const auto winner = decision_slot(game, {1, 0, 0}, 7, std::nullopt);
  REQUIRE(winner);
  CHECK(winner->player == 1);
  CHECK(winner->to == 2);
}

TEST_CASE("everybody who asks may win the lottery, and the same seed repeats") {
  const auto game = cell_game(1, taking_turns());
  const auto start = game.all_local();
  std::set<std::size_t> winners;
  for (std::uint64_t slot = 0; slot < 1000; ++slot)
    winners.insert(decision_slot(game, start, slot, lottery(1))->player);
  CHECK(winners.size() == game.players().size());

  const auto once = play(game, start, lottery(5));
  CHECK(play(game, start, lottery(5)).choices == once.choices);
  CHECK(play(game, start, lottery(6)).choices != once.choices);
}

TEST_CASE("every move lowers the potential") {
  for_each_start([](const offloading_game& game, profile a, auto seed) {
    std::uint64_t slot = 0;
    while (const auto move = decision_slot(game, a, slot++, lottery(seed))) {
      const auto before = potential(game, a);
      const auto cost_before = game.cost(a, move->player);
      a[move->player] = move->to;
      REQUIRE(potential(game, a) < before);
      REQUIRE(game.cost(a, move->player) < cost_before);
    }
  });
}

TEST_CASE("the potential falls by what a mover is spared, times its weight") {
  // Equations (18) and (19): the mover is spared the weight that it received;
  // computing locally counts as receiving one's threshold.
  for_each_start([](const offloading_game& game, profile a, auto seed) {
    const auto level = [&](std::size_t n) {
      return a[n] == locally ? game.threshold(n) : game.received(a, n, a[n]);
    };
    const auto move = decision_slot(game, a, 0, lottery(seed));
    REQUIRE(move);
    const auto before = potential(game, a);
    const auto level_before = level(move->player);
    a[move->player] = move->to;
    const auto weight = game.model().weight(game.players()[move->player]);
    REQUIRE(std::abs(before - potential(game, a)
                     - weight * (level_before - level(move->player)))
            <= 1e-12 * std::abs(before));
  });
}

TEST_CASE("at the end nobody can do better alone") {
  for_each_start(
      [](const offloading_game& game, const profile& start, auto seed) {
        const auto a = play(game, start, lottery(seed)).choices;
        REQUIRE(is_equilibrium(game, a));
        for (std::size_t n = 0; n < a.size(); ++n)
          for (choice c = locally; c <= game.channels(); ++c) {
            auto other = a;
            other[n] = c;
            REQUIRE(game.cost(other, n) >= game.cost(a, n) * (1 - 1e-8));
          }
      });
}

TEST_CASE("a crowd on one channel is no equilibrium") {
  for (const auto& model : both_models()) {
    const auto game = cell_game(1, model);
    CHECK(!is_equilibrium(game, profile(30, 1)));
  }
}

TEST_CASE("everybody who offloads at the end gains by it") {
  for_each_start(
      [](const offloading_game& game, const profile& start, auto seed) {
        const auto a = play(game, start, lottery(seed)).choices;
        REQUIRE(offloaders(a) > 0);
        REQUIRE(beneficial_users(game, a) == offloaders(a));
      });
}

TEST_CASE("an equilibrium costs no more than the average crowd would") {
  for_each_start(
      [](const offloading_game& game, const profile& start, auto seed) {
        const auto a = play(game, start, lottery(seed)).choices;
        const auto bounds = costs_in_theory(game);
        REQUIRE(total_cost(game, a) <= bounds.most * (1 + 1e-9));
        REQUIRE(total_cost(game, a) >= bounds.least * (1 - 1e-9));
      });
}

TEST_CASE("the price of anarchy is within what theory allows") {
  std::size_t bounded = 0;
  for (const auto& model : both_models())
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const offloading_game game{users(7, seed), 2, model};
      const auto best = brute_force(game);
      const auto a = play(game, game.all_local(), lottery(seed)).choices;
      const auto bounds = costs_in_theory(game);
      const auto price = total_cost(game, a) / best.least_cost;
      REQUIRE(price >= 1 - 1e-12);
      REQUIRE(price <= bounds.most / bounds.least * (1 + 1e-9));

      const auto share = least_share_of_users(game);
      if (!share)
        continue;
      bounded += *share > 0;
      const auto gaining = static_cast<double>(beneficial_users(game, a));
      REQUIRE(gaining <= static_cast<double>(best.most_users));
      REQUIRE(gaining >= *share * static_cast<double>(best.most_users));
    }
  CHECK(bounded > 0); // some bounds say something
}

TEST_CASE("seven players on two channels pay a tenth more than they must") {
  double cost = 0;
  double most_cost = 0;
  double gaining = 0;
  constexpr std::uint64_t games = 30;
  for (std::uint64_t seed = 0; seed < games; ++seed) {
    const offloading_game game{users(7, seed), 2, taking_turns()};
    const auto best = brute_force(game);
    const auto a = play(game, game.all_local(), lottery(seed)).choices;
    const auto price = total_cost(game, a) / best.least_cost;
    cost += price / games;
    most_cost = std::max(most_cost, price);
    gaining += static_cast<double>(beneficial_users(game, a))
               / static_cast<double>(best.most_users) / games;
  }
  CHECK(cost == doctest::Approx(1.096).epsilon(0.03));
  CHECK(most_cost < 1.3);
  CHECK(gaining == doctest::Approx(0.907).epsilon(0.05));
}

} // namespace sofof::policies::game
