// Tests of the offloading game as one vehicle sees it.
#include "tests/support/roadside.hpp"

#include <vector>

using namespace sofof;
using namespace sofof::policies;
using test::after;
using test::comes_home;
using test::goes_to;
using test::make_lodm_with;
using test::roadside;

namespace {

std::unique_ptr<local_policy> hasty() {
  return make_lodm_with("best_response", {.numbers = {{"probability", 1}}});
}

} // namespace

TEST_CASE_FIXTURE(roadside, "the best response is where fewest contend, as far "
                            "as workers are scarce") {
  const auto lodm = hasty();
  add(1).utilisation = 0.9;
  add(2).utilisation = 0.2;
  CHECK(goes_to(ask(*lodm)) == 2);
  // One result takes 8 ms, however many workers idle.
  providers[1].workers = 100;
  providers[0].utilisation = 0;
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(roadside,
                  "where many are already it stays on board, and comes "
                  "home when it gets too crowded") {
  const auto lodm = hasty();
  // Each needs 0.16 of a worker. With N on two workers a result takes 12 + 4 N
  // ms, at 0.006 a millisecond; 0.249 less 0.02 may be spent, then 0.249 and
  // 0.02.
  add(1).utilisation = 5 * 0.08;
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[0].utilisation = 6 * 0.08;
  CHECK(!goes_to(ask(*lodm)));
  runs_at(1);
  providers[0].utilisation = 8 * 0.08; // it is one of the eight
  CHECK(!comes_home(ask(*lodm)));
  providers[0].utilisation = 9 * 0.08;
  CHECK(comes_home(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside, "a move must save more than the margin") {
  const auto lodm = make_lodm_with(
      "best_response", {.numbers = {{"probability", 1}, {"margin", 0.1}}});
  add(1);
  add(2).cost.energy_j = 0.002; // saves 0.089
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[1].cost.energy_j = 0.0005; // 0.106
  CHECK(goes_to(ask(*lodm)) == 2);
}

TEST_CASE_FIXTURE(roadside, "in a slot one in five moves, and a slot that is "
                            "played again ends alike") {
  const auto lodm = make_lodm("best_response");
  add(1);
  int moves = 0;
  for (seen.number = 0; seen.number < 3000; ++seen.number) {
    const auto source = goes_to(ask(*lodm));
    CHECK(goes_to(ask(*lodm)) == source);
    moves += source == 1 ? 1 : 0;
  }
  CHECK(moves == doctest::Approx(600).epsilon(0.1));
}

TEST_CASE("vehicles that play it come to rest, spread over two providers") {
  constexpr std::size_t vehicles = 20;
  std::vector<service_place> at(vehicles);
  const auto lodm = make_lodm("best_response");
  std::size_t moved_last = 0;
  for (std::size_t slot = 0; slot < 400; ++slot)
    for (std::size_t n = 0; n < vehicles; ++n) {
      roadside one;
      one.seen.noise = random_stream{1, "vehicles"}.part(n);
      one.seen.number = slot;
      for (const provider_id id : {1, 2})
        one.add(id).utilisation =
            0.08 * static_cast<double>(std::ranges::count(at, id));
      one.runs_at(at[n]);
      const auto to = after(one.ask(*lodm), at[n]);
      if (to != at[n])
        moved_last = slot;
      at[n] = to;
    }
  CHECK(moved_last < 200);
  CHECK(std::ranges::count(at, 1) == 6);
  CHECK(std::ranges::count(at, 2) == 6);
}
