// Ids of one kind are numbers, those of two kinds have nothing in common.
#include "base/strong_id.hpp"

#include "base/ids.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <set>
#include <type_traits>
#include <unordered_set>

using namespace sofof;

static_assert(std::is_convertible_v<std::uint32_t, station_id>);
static_assert(!std::is_convertible_v<station_id, std::uint32_t>);
static_assert(!std::is_convertible_v<station_id, sender_id>);
static_assert(!std::is_constructible_v<provider_id, station_id>);
static_assert(!std::is_constructible_v<provider_id, sender_id>);
static_assert(!std::equality_comparable_with<station_id, provider_id>);
static_assert(sizeof(station_id) == sizeof(std::uint32_t));

TEST_CASE("an id is its number, in order and in text") {
  const station_id one = 101, other{102};
  CHECK(one == 101);
  CHECK(one != other);
  CHECK(one < other);
  CHECK(one.value() == 101u);
  CHECK(station_id{} == 0);
  CHECK(fmt::format("{} {:>5}", one, other) == "101   102");
}

TEST_CASE("ids are kept in sets of either kind") {
  const std::set<station_id> sorted{103, 101, 101};
  CHECK(sorted.size() == 2);
  CHECK(*sorted.begin() == 101);
  const std::unordered_set<provider_id> hashed{7, 7, 9};
  CHECK(hashed.size() == 2);
  CHECK(hashed.contains(9));
}

TEST_CASE("a provider that boots anew keeps its place") {
  CHECK(place_of(provider_at(3, 1'700'000'000'000)) == 3);
  CHECK(provider_at(3, 1) != provider_at(3, 2));
  CHECK(is_obstacle(obstacle_id(0), 1));
  CHECK_FALSE(is_obstacle(obstacle_id(1), 1));
}
