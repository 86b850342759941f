// Scenarios with faults that are made up of seeds.
#include "experiments/torture/draw.hpp"
#include "experiments/torture/tried_scenario.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

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

TEST_CASE("a third of what is drawn has a chain of services, in any split "
          "over the providers") {
  int chains = 0, alone = 0;
  std::set<std::vector<std::string>> offered;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const auto s = load({draw(seed)}).what;
    if (!scenario::find_service(s, "tracking"))
      continue;
    ++chains;
    alone += s.services.size() == 3;
    for (const auto& p : s.providers) {
      auto links = p.services;
      std::erase(links, "cabin_climate");
      std::erase(links, "synthetic_load");
      offered.insert(links);
    }
  }
  CHECK(chains > seeds / 4);
  CHECK(chains < seeds / 2);
  CHECK(alone > chains / 3);
  CHECK(offered.size() == 8); // seven, and none that are named: all
}
