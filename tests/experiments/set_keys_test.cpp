// Keys of --set, for completion.
#include "experiments/schema/set_keys.hpp"

#include "experiments/schema/file_schemas.hpp"
#include "experiments/schema/json_schema.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

namespace sofof::test::set_keys {

using namespace sofof::experiments::schema;

const std::vector<set_key>& all_keys() {
  static const auto all =
      sofof::experiments::schema::set_keys(scenario_options());
  return all;
}

std::vector<std::string> values_of(const std::string& key) {
  const auto i = std::ranges::find(all_keys(), key, &set_key::key);
  CAPTURE(key);
  REQUIRE(i != all_keys().end());
  return i->values;
}

TEST_CASE("Keys of --set have the values that there are") {
  CHECK(values_of("record.tracks")
        == std::vector<std::string>{"false", "true"});
  CHECK(std::ranges::count(values_of("policies.lodm"), "nearest") == 1);
  CHECK(std::ranges::count(values_of("policies.codm"), "nearest") == 0);
  CHECK(std::ranges::count(values_of("network.profile"), "paper_5g") == 1);
  CHECK(std::ranges::count(values_of("service.trajectory_planning.max_latency"),
                           "scene")
        == 1);
  CHECK(values_of("fleet.0.count").empty());
}

TEST_CASE("Keys of --set stand once each, and none at a former place") {
  std::vector<std::string> keys;
  for (const auto& key : all_keys())
    keys.push_back(key.key);
  CHECK(keys.size() > 300);
  std::ranges::sort(keys);
  CHECK(std::ranges::adjacent_find(keys) == keys.end());
  CHECK(std::ranges::count(keys, "network.workers") == 0);
  CHECK(std::ranges::count(keys, "compute.workers") == 1);
}

TEST_CASE("Each key of --set is one that sweeps may vary") {
  const std::regex pattern{path_pattern(scenario_options())};
  for (const auto& key : all_keys()) {
    CAPTURE(key.key);
    CHECK(std::regex_match(key.key, pattern));
  }
}

} // namespace sofof::test::set_keys
