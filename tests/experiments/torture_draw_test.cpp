// Scenarios with faults that are made up of seeds.
#include "experiments/torture/draw.hpp"
#include "experiments/torture/tried_scenario.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

using namespace sofof;
using namespace sofof::experiments::torture;

namespace {

constexpr std::uint64_t seeds = 400;

int draws_with(std::string_view word) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    count += draw(seed).find(word) != std::string::npos;
  return count;
}

} // namespace

TEST_CASE("the same seed gives the same scenario, another one another") {
  CHECK(draw(7) == draw(7));
  CHECK(draw(7) != draw(8));
}

TEST_CASE("every scenario that is drawn can be loaded, and is fair") {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CAPTURE(seed);
    const auto s = load({draw(seed)}).what;
    CHECK(s.seed == static_cast<std::int64_t>(seed));
    CHECK(s.name == name_of(seed));
    CHECK(s.traffic.grants_crossings());
    CHECK(s.obstacles.empty());
    CHECK_FALSE(s.providers.empty());
  }
}

TEST_CASE(
    "more than half of what is drawn plans with al_ilqr, and each fault is "
    "drawn") {
  CHECK(draws_with("al_ilqr") > seeds / 2);
  for (const auto* fault :
       {"loss = ", "burst_loss", "stalls", "spikes", "drift", "more_delay",
        "cell_mbps", "outage", "direction", "disorder", "fails_at",
        "returns_at", "[lies]", "[hostile]", "map = \"none\""}) {
    CAPTURE(fault);
    CHECK(draws_with(fault) > static_cast<int>(seeds) / 100);
  }
}
