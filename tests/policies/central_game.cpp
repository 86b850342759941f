// Tests of best_response at a provider: the game of all who ask and are served.
#include "tests/policies/scene.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;

namespace {

/// What computing 8 ms alone within 50 ms costs.
constexpr double computes_alone = 0.3 * 8 / 50;

} // namespace

TEST_CASE("as many play on a worker as it pays beside the others") {
  scene at;
  at.ask_alike(14, 0.08, 5.5 * computes_alone);
  CHECK(std::ranges::count(at.verdicts("best_response"), 'h') == 6);
  scene two;
  two.workers = 2;
  two.ask_alike(14, 0.04, 5.5 * computes_alone); // of two workers
  const auto all = two.decide(*codm_of("best_response"));
  CHECK(std::ranges::count_if(all, is_accepted) == 12);
  CHECK(std::ranges::count_if(all,
                              [](const auto& d) {
                                return is_accepted(d)
                                       && terms_of(d)->worker == 1;
                              })
        == 6);
}

TEST_CASE("where each is the other's noise, fewer play") {
  scene at;
  at.ask_alike(14, 0.08, 5.5 * computes_alone);
  const auto all =
      at.verdicts(*codm_of("best_response", {{"model", "interference"}}));
  // Two cost log2(101) / log2(1 + 1 / 1.01) = 6.7 times as much as one.
  CHECK(std::ranges::count(all, 'h') == 1);
}

TEST_CASE("nobody would rather have decided differently") {
  dice random{4};
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    scene at;
    at.workers = 1 + k % 3;
    const auto share = 0.08 / static_cast<double>(at.workers);
    std::vector<double> wins;
    for (int n = 0; n < 12; ++n) {
      wins.push_back(random.between(0.11, 0.5));
      at.ask(share, {{self, wins.back(), 0}});
    }
    for (int n = 0; n < 4; ++n) {
      const auto gain = random.between(0.11, 0.5);
      wins.push_back(gain + price);
      at.run(share, {{self, gain, 0}}, static_cast<std::size_t>(n));
    }
    const auto all = at.decide(*codm_of("best_response"), k);
    std::vector<int> on(at.workers);
    for (const auto& d : all)
      if (const auto* terms = terms_of(d))
        ++on.at(terms->worker);
    const auto least = *std::ranges::min_element(on);
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (const auto* terms = terms_of(all[n])) {
        CHECK(wins[n] >= computes_alone * (on[terms->worker] - 1) - rounding);
        CHECK(on[terms->worker] <= least + 1);
      } else {
        CHECK(wins[n] <= computes_alone * least + rounding);
      }
    }
  }
}

TEST_CASE("a player is crowded out by others, never by itself") {
  scene at;
  at.run(0.08, {{self, -3, 0}});
  CHECK(at.verdicts("best_response") == "h");
  at.ask_alike(1, 0.08, 0.5);
  CHECK(at.verdicts("best_response") == "hh");
  at.ask_alike(9, 0.08, 0.5);
  CHECK(at.verdicts("best_response").ends_with('-'));
}

TEST_CASE("who finds it too crowded is told who would be better, if there is "
          "room") {
  scene at;
  at.ask_alike(11, 0.08, 0.5);
  at.ask(
      0.08,
      {{self, 0.1, 0}, {second, 0.3, 0.95}, {third, 0.2, 0.1}, {44, 0.1, 0.1}});
  at.ask(0.08, {{self, 0.1, 0}, {third, -0.2, 0.1}});
  const auto all = at.decide(*codm_of("best_response"));
  CHECK(!is_accepted(all[11]));
  CHECK(instead_of(all[11]) == third);
  CHECK(!is_accepted(all[12]));
  CHECK(!instead_of(all[12]));
}
