// The offloading game against the figures of Chen, Jiao, Li & Fu, ToN 24(5),
// 2016, sections IV-VII.
//
// Figures 5 and 6 are read off their bars, to one or two units. What the paper
// says in words is exact: best response costs up to 68 % less than computing
// everything locally. It then names 55 % and 51 % for offloading everything;
// the bars allow 55 %, and exceed 51 %.
//
// The figures follow the paper's contention model with equal weights, though
// the text speaks of its interference model: see the last test.
#include "policies/algorithms/game/best_response.hpp"

#include "tests/support/game_laws.hpp"
#include "tests/support/radio_cell.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace sofof::policies::game {

using namespace test;

namespace {

constexpr std::uint64_t runs = 500; // the paper: 100

// One bar of each colour.
struct bars {
  std::size_t users;
  double best_response_cost;
  double all_offload_cost;
  double all_local_cost;
  double best_response_users;
  double all_offload_users;
};

constexpr std::array published{
    bars{15, 10, 12, 27, 15, 12}, bars{20, 13, 20, 36, 18, 15},
    bars{25, 17, 28, 45, 21, 17}, bars{30, 25, 41, 54, 24, 20},
    bars{35, 31, 63, 63, 28, 23}, bars{40, 36, 79, 71, 30, 24},
    bars{45, 40, 87, 80, 33, 26}, bars{50, 50, 105, 88, 37, 29},
};

// Means over all runs.
struct measured {
  double best_response_cost = 0;
  double all_offload_cost = 0;
  double all_local_cost = 0;
  double best_response_users = 0;
  double all_offload_users = 0;
  double slots = 0;
};

measured measure(std::size_t count,
                 const std::shared_ptr<const channel_model>& model) {
  measured mean;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const offloading_game game{users(count, run), radio_cell::channels, model};
    const auto local = game.all_local();
    const auto blind = blindly_offloaded(game, run);
    const auto found = play(game, local, random_stream{run, "lottery"});
    const auto gaining = [&](const profile& a) {
      return static_cast<double>(beneficial_users(game, a)) / runs;
    };
    mean.best_response_cost += total_cost(game, found.choices) / runs;
    mean.all_offload_cost += total_cost(game, blind) / runs;
    mean.all_local_cost += total_cost(game, local) / runs;
    mean.best_response_users += gaining(found.choices);
    mean.all_offload_users += gaining(blind);
    mean.slots += static_cast<double>(found.slots) / runs;
  }
  return mean;
}

const measured& taking_turns(std::size_t count) {
  static const auto all = [] {
    std::array<measured, published.size()> rows;
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k] = measure(published[k].users, test::taking_turns());
    return rows;
  }();
  return all[count / 5 - 3];
}

doctest::Approx about(double cost) {
  return doctest::Approx(cost).scale(0).epsilon(0.12);
}

constexpr double users_tolerance = 6;

} // namespace

TEST_CASE("best response costs what Chen's figure 6 shows") {
  for (const auto& row : published) {
    if (row.users == 15)
      continue; // the next test
    CAPTURE(row.users);
    CHECK(taking_turns(row.users).best_response_cost
          == about(row.best_response_cost));
  }
}

TEST_CASE("15 users save what Chen's text says, and its figure does not") {
  // 68 % below the 27 of computing locally is 8.6, and no other bar comes near
  // 68 %; the bar is read as 10, which also is 25 % above the optimum's 8,
  // where the text allows 14 %.
  const auto& mean = taking_turns(15);
  const auto saved = 1 - mean.best_response_cost / mean.all_local_cost;
  CHECK(saved == doctest::Approx(0.68).epsilon(0.03));
  CHECK(mean.best_response_cost == about(0.32 * 27));
}

TEST_CASE("50 users save what Chen's text says they do over offloading all") {
  const auto& mean = taking_turns(50);
  const auto saved = 1 - mean.best_response_cost / mean.all_offload_cost;
  CHECK(saved == doctest::Approx(0.55).epsilon(0.03));
}

TEST_CASE("offloading all, or nothing, costs what Chen's figure 6 shows") {
  for (const auto& row : published) {
    CAPTURE(row.users);
    const auto& mean = taking_turns(row.users);
    CHECK(mean.all_offload_cost == about(row.all_offload_cost));
    CHECK(mean.all_local_cost == about(row.all_local_cost));
  }
}

TEST_CASE("as many users gain by best response as Chen's figure 5 shows") {
  for (const auto& row : published) {
    CAPTURE(row.users);
    const auto off =
        taking_turns(row.users).best_response_users - row.best_response_users;
    CHECK(std::abs(off) <= users_tolerance);
  }
}

TEST_CASE("as many gain when all offload as Chen's figure 5 shows, up to 45") {
  for (const auto& row : published) {
    if (row.users == 50)
      continue; // the next test
    CAPTURE(row.users);
    const auto off =
        taking_turns(row.users).all_offload_users - row.all_offload_users;
    CHECK(std::abs(off) <= users_tolerance);
  }
}

TEST_CASE("of 50 who all offload fewer gain than Chen's figure 5 shows") {
  // Measured: 21 instead of 29, after 20 % too few at 45. With ten on a channel
  // hardly anybody gains for whom time matters; links fast enough for them
  // would cost less than figure 6 shows.
  CHECK(taking_turns(50).all_offload_users
        == doctest::Approx(21.4).epsilon(0.05));
}

TEST_CASE("decision slots grow in proportion to the users") {
  // One slot a user; figure 7 has 1.3 to 1.6.
  for (const auto& row : published) {
    CAPTURE(row.users);
    const auto slots_per_user =
        taking_turns(row.users).slots / static_cast<double>(row.users);
    CHECK(slots_per_user == doctest::Approx(1.0).epsilon(0.08));
  }
}

TEST_CASE("the interference model as printed lets a fifth of 30 users gain") {
  // And offloading everything costs more than ten thousand times the 41 of
  // figure 6: its equation (1) with its settings does not make its figures.
  const auto mean = measure(30, all_at_once());
  CHECK(mean.best_response_users == doctest::Approx(5.5).epsilon(0.1));
  CHECK(mean.best_response_cost == doctest::Approx(43.5).epsilon(0.05));
  CHECK(mean.all_offload_cost > 4.1e5);
}

} // namespace sofof::policies::game
