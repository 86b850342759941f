// Tests of what policies are told of the future.
#include "scenario/foresight.hpp"

#include "scenario/load.hpp"
#include "tests/scenario/bench_town.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;
using namespace std::chrono_literals;

namespace {

constexpr std::string_view planning = "trajectory_planning";

foreseen_results look(const std::vector<std::string>& set, boot_id provider,
                      duration from, duration until) {
  const auto s = parse_scenario(test::bench_town, "town.toml", set);
  return foresee(s)(101)->look(provider, planning, time_point{from},
                               time_point{until});
}

} // namespace

TEST_CASE("on an ideal channel nothing is late and computing is all it takes") {
  const auto seen = look({}, boot_of(1, 0), 0s, 60s);
  CHECK_FALSE(seen.late);
  CHECK(seen.latency_s == doctest::Approx(0.008));
}

TEST_CASE("where nobody is everything is late") {
  CHECK(look({}, boot_of(2, 0), 3s, 60s).late == time_point{3s});
}

TEST_CASE("it is foreseen when a provider fails and when it is back") {
  const std::vector<std::string> set{"provider.0.fails_at=20s",
                                     "provider.0.returns_at=30s"};
  const auto before = look(set, boot_of(1, 0), 0s, 60s);
  REQUIRE(before.late);
  CHECK(before.late->time_since_epoch() > 19900ms);
  CHECK(before.late->time_since_epoch() <= 20100ms);
  CHECK(look(set, boot_of(1, 1), 29s, 60s).late);
  CHECK_FALSE(look(set, boot_of(1, 1), 30s, 60s).late);
}
