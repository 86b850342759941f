// Tests of whether offloading pays in computing time.
#include "recording/cpu_balance.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::recording;
using namespace sofof::test;

namespace {

// Dehler & Buchholz 2025, table "CPU".
constexpr cpu_shares paper_simulation{19.5, 8.5, 0.96, 0.96};
constexpr cpu_shares paper_drives{116.1, 28.3, 2.61, 2.61};

} // namespace

TEST_CASE("the paper's table gives other break-even shares than it prints") {
  // It prints 7.93 % and 6.15 %.
  CHECK(100 * break_even_share(paper_simulation).value()
        == near(8.727, 0.0005));
  CHECK(100 * break_even_share(paper_drives).value() == near(2.973, 0.0005));
}

TEST_CASE("at the break-even share offloading neither costs nor saves") {
  for (const auto& c : {paper_simulation, paper_drives}) {
    const auto even = break_even_share(c).value();
    CHECK(share_with_offloading(c, even)
          == near(share_without_offloading(c), 1e-12));
    CHECK(share_with_offloading(c, 0.9 * even) > share_without_offloading(c));
    CHECK(share_with_offloading(c, 1.1 * even) < share_without_offloading(c));
  }
}

TEST_CASE("who never offloads pays for the requester all the same") {
  CHECK(share_with_offloading(paper_simulation, 0) == near(20.46, 1e-12));
  CHECK(share_with_offloading(paper_simulation, 1) == near(9.46, 1e-12));
}

TEST_CASE("a cheap planner never pays for a dear requester") {
  CHECK(break_even_share({0.5, 0.1, 0.8, 0.8}).value() == near(2, 1e-12));
}

TEST_CASE("a requester that costs more while it is used moves the break-even") {
  constexpr cpu_shares c{0.2, 0, 0.02, 0.12};
  const auto even = break_even_share(c).value();
  CHECK(even == near(0.2, 1e-12)); // 0.02 of 0.2 + 0.02 - 0.12
  CHECK(share_with_offloading(c, even) == near(0.2, 1e-12));
  CHECK(break_even_share({0.2, 0, 0.02, 0.22}) == std::nullopt);
}

TEST_CASE("a function that costs as much deactivated gains nothing") {
  CHECK(break_even_share({1, 1, 0.1, 0.1}) == std::nullopt);
  CHECK(break_even_share({1, 2, 0.1, 0.1}) == std::nullopt);
}

TEST_CASE("a core that is busy for a tenth of the time takes its watts") {
  // 10 % of (3.5 - 0.74) W for the 100 s of a kilometre.
  CHECK(energy_j_per_km(10, 10) == near(27.6, 1e-12));
  CHECK(energy_j_per_km(10, 20) == near(13.8, 1e-12));
  CHECK(energy_j_per_km(100, 10, {.idle_w = 2, .busy_w = 12})
        == near(1000, 1e-12));
}
