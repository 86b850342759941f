// Tests of back-pressure: the latest value wins.
#include "network/flow/conflating_queue.hpp"

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
using namespace sofof::network;
using test::dice;

namespace {

using namespace std::chrono_literals;

using streams = conflating_queue<std::string, int>;

constexpr duration longest_wait = 1s;
constexpr time_point t{10s};

} // namespace

TEST_CASE("a value of a stream with credit is sent at once") {
  streams s{10, longest_wait};
  CHECK(s.offer("cam", 1, t) == 1);
  CHECK(s.offer("cpm", 2, t) == 2);
  CHECK(s.size() == 2);
}

TEST_CASE("a value waits for the credit and then takes it") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  CHECK(!s.offer("cam", 2, t));
  CHECK(s.acknowledge("cam", t) == 2);
  CHECK(!s.offer("cam", 3, t));
  CHECK(s.acknowledge("cam", t) == 3);
  CHECK(!s.acknowledge("cam", t));
  CHECK(s.offer("cam", 4, t) == 4);
}

TEST_CASE("of the values that wait the latest wins") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  for (int k = 2; k <= 5; ++k)
    CHECK(!s.offer("cam", k, t));
  CHECK(s.acknowledge("cam", t) == 5);
  CHECK(!s.acknowledge("cam", t));
}

TEST_CASE("a stream that stalls does not hold up another") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  s.offer("cam", 2, t);
  CHECK(s.offer("cpm", 3, t) == 3);
  CHECK(!s.acknowledge("cpm", t));
  CHECK(s.offer("cpm", 4, t) == 4);
}

TEST_CASE("an acknowledgement of nothing makes no second credit") {
  streams s{10, longest_wait};
  CHECK(!s.acknowledge("cam", t));
  CHECK(s.offer("cam", 1, t) == 1);
  CHECK(!s.acknowledge("cam", t));
  CHECK(!s.acknowledge("cam", t));
  CHECK(s.offer("cam", 2, t) == 2);
  CHECK(!s.offer("cam", 3, t));
}

TEST_CASE("a stream whose acknowledgement got lost goes on after a while") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  CHECK(!s.offer("cam", 2, t + longest_wait - 1ns));
  CHECK(s.offer("cam", 3, t + longest_wait) == 3);
  CHECK(!s.offer("cam", 4, t + 2 * longest_wait - 1ns));
  CHECK(s.acknowledge("cam", t + 2 * longest_wait) == 4);
  CHECK(!s.offer("cam", 5, t + 3 * longest_wait - 1ns));
  CHECK(s.offer("cam", 6, t + 3 * longest_wait) == 6);
  CHECK(s.size() == 1);
}

TEST_CASE("what waits in a forgotten stream is not sent") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  s.offer("cam", 2, t);
  s.forget("cam");
  s.forget("cpm");
  CHECK(s.size() == 0);
  CHECK(!s.acknowledge("cam", t));
  CHECK(s.offer("cam", 3, t) == 3);
}

TEST_CASE("after the loss of the connection all streams have credit") {
  streams s{10, longest_wait};
  s.offer("cam", 1, t);
  s.offer("cpm", 2, t);
  s.offer("cpm", 3, t);
  s.clear();
  CHECK(s.size() == 0);
  CHECK(s.offer("cam", 4, t) == 4);
  CHECK(s.offer("cpm", 5, t) == 5);
}

TEST_CASE("a stream beyond the most loses its values until there is room") {
  streams s{2, longest_wait};
  s.offer("a", 1, t);
  s.offer("b", 2, t);
  CHECK(!s.offer("c", 3, t));
  CHECK(s.size() == 2);
  CHECK(!s.acknowledge("c", t));
  CHECK(!s.offer("a", 4, t)); // those that are there go on
  CHECK(s.acknowledge("a", t) == 4);
  CHECK(!s.acknowledge("a", t));
  CHECK(s.offer("c", 5, t) == 5);
}

TEST_CASE("values need not be copied") {
  conflating_queue<int, std::unique_ptr<int>> s{1, longest_wait};
  CHECK(**s.offer(1, std::make_unique<int>(7), t) == 7);
  CHECK(!s.offer(1, std::make_unique<int>(8), t));
  CHECK(**s.acknowledge(1, t) == 8);
}

TEST_CASE("whatever happens, at most one value of a stream is on its way, none "
          "overtakes, and the last one gets through") {
  constexpr std::size_t number = 5;
  dice random{9};
  for (int series = 0; series < 300; ++series) {
    conflating_queue<std::size_t, int> s{number, longest_wait};
    std::array<std::vector<int>, number> offered;
    std::array<std::vector<int>, number> sent;
    std::array<int, number> on_the_way{};
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
      send(key, s.acknowledge(key, t));
    };
    const auto share = random.between(0.1, 0.9);
    for (int k = 0; k < 300; ++k) {
      const auto key = static_cast<std::size_t>(random.between(0, number));
      if (random.between(0, 1) < share)
        arrive(key);
      else {
        offered[key].push_back(k);
        send(key, s.offer(key, k, t));
      }
      REQUIRE(s.size() <= number);
    }
    for (std::size_t key = 0; key < number; ++key) {
      while (on_the_way[key] > 0)
        arrive(key);
      CHECK(std::is_sorted(sent[key].begin(), sent[key].end()));
      if (!offered[key].empty())
        CHECK(sent[key].back() == offered[key].back());
    }
    CHECK(s.size() == 0);
  }
}
