// Tests of back-pressure: the latest value wins.
#include "policies/latest_value.hpp"

#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using test::dice;

namespace {

using streams = latest_values<std::string, int>;

} // namespace

TEST_CASE("a value of a stream with credit is sent at once") {
  streams s{10};
  CHECK(s.offer("cam", 1) == 1);
  CHECK(s.offer("cpm", 2) == 2);
  CHECK(s.size() == 2);
  CHECK(s.replaced() == 0);
}

TEST_CASE("a value waits for the credit and then takes it") {
  streams s{10};
  s.offer("cam", 1);
  CHECK(!s.offer("cam", 2));
  CHECK(s.acknowledge("cam") == 2);
  CHECK(!s.offer("cam", 3));
  CHECK(s.acknowledge("cam") == 3);
  CHECK(!s.acknowledge("cam"));
  CHECK(s.offer("cam", 4) == 4);
}

TEST_CASE("of the values that wait the latest wins, and the others are "
          "counted") {
  streams s{10};
  s.offer("cam", 1);
  for (int k = 2; k <= 5; ++k)
    CHECK(!s.offer("cam", k));
  CHECK(s.replaced() == 3);
  CHECK(s.acknowledge("cam") == 5);
  CHECK(!s.acknowledge("cam"));
}

TEST_CASE("a stream that stalls does not hold up another") {
  streams s{10};
  s.offer("cam", 1);
  s.offer("cam", 2);
  CHECK(s.offer("cpm", 3) == 3);
  CHECK(!s.acknowledge("cpm"));
  CHECK(s.offer("cpm", 4) == 4);
}

TEST_CASE("an acknowledgement of nothing makes no second credit") {
  streams s{10};
  CHECK(!s.acknowledge("cam"));
  CHECK(s.offer("cam", 1) == 1);
  CHECK(!s.acknowledge("cam"));
  CHECK(!s.acknowledge("cam"));
  CHECK(s.offer("cam", 2) == 2);
  CHECK(!s.offer("cam", 3));
}

TEST_CASE("what waits in a forgotten stream is not sent") {
  streams s{10};
  s.offer("cam", 1);
  s.offer("cam", 2);
  s.forget("cam");
  s.forget("cpm");
  CHECK(s.size() == 0);
  CHECK(!s.acknowledge("cam"));
  CHECK(s.offer("cam", 3) == 3);
}

TEST_CASE("after the loss of the connection all streams have credit") {
  streams s{10};
  s.offer("cam", 1);
  s.offer("cpm", 2);
  s.offer("cpm", 3);
  s.clear();
  CHECK(s.size() == 0);
  CHECK(s.offer("cam", 4) == 4);
  CHECK(s.offer("cpm", 5) == 5);
}

TEST_CASE("a stream beyond the most loses its values until there is room") {
  streams s{2};
  s.offer("a", 1);
  s.offer("b", 2);
  CHECK(!s.offer("c", 3));
  CHECK(s.dropped() == 1);
  CHECK(s.size() == 2);
  CHECK(!s.acknowledge("c"));
  CHECK(!s.offer("a", 4)); // those that are there go on
  CHECK(s.acknowledge("a") == 4);
  CHECK(!s.acknowledge("a"));
  CHECK(s.offer("c", 5) == 5);
  CHECK(s.dropped() == 1);
}

TEST_CASE("values need not be copied") {
  latest_values<int, std::unique_ptr<int>> s{1};
  CHECK(**s.offer(1, std::make_unique<int>(7)) == 7);
  CHECK(!s.offer(1, std::make_unique<int>(8)));
  CHECK(**s.acknowledge(1) == 8);
}

TEST_CASE("whatever happens, at most one value of a stream is on its way, none "
          "overtakes, and the last one gets through") {
  constexpr std::size_t number = 5;
  dice random{9};
  for (int series = 0; series < 300; ++series) {
    latest_values<std::size_t, int> s{number};
    std::array<std::vector<int>, number> offered;
    std::array<std::vector<int>, number> sent;
    std::array<int, number> on_the_way{};
    std::uint64_t all_offered = 0;
    const auto send = [&](std::size_t key, std::optional<int> value) {
      if (!value)
        return;
      sent[key].push_back(*value);
      REQUIRE(++on_the_way[key] == 1);
    };
    const auto arrive = [&](std::size_t key) {
      if (on_the_way[key] == 0)
        return;
      --on_the_way[key];
      send(key, s.acknowledge(key));
    };
    const auto patience = random.between(0.1, 0.9);
    for (int k = 0; k < 300; ++k) {
      const auto key = static_cast<std::size_t>(random.between(0, number));
      if (random.between(0, 1) < patience)
        arrive(key);
      else {
        offered[key].push_back(k);
        ++all_offered;
        send(key, s.offer(key, k));
      }
      REQUIRE(s.size() <= number);
    }
    std::uint64_t all_sent = 0;
    for (std::size_t key = 0; key < number; ++key) {
      while (on_the_way[key] > 0)
        arrive(key);
      all_sent += sent[key].size();
      CHECK(std::is_sorted(sent[key].begin(), sent[key].end()));
      if (!offered[key].empty())
        CHECK(sent[key].back() == offered[key].back());
    }
    CHECK(s.size() == 0);
    CHECK(all_sent + s.replaced() == all_offered);
    CHECK(s.dropped() == 0);
  }
}
