// Tests of which news of peers people hear, and which the log has.
#include "network/flow/news_filter.hpp"
#include "network/flow/sampled_log.hpp"
#include "tests/support/at.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using namespace sofof::network;
using namespace std::chrono_literals;
using test::at;

TEST_CASE("the same news are heard once, until there are others") {
  news_filter news;
  CHECK(news.passes("it is gone", at(1s)));
  CHECK_FALSE(news.passes("it is gone", at(2s)));
  CHECK(news.passes("it is back", at(3s)));
  CHECK(news.passes("it is gone", at(4s)));
}

TEST_CASE("of a peer that comes and goes all the time twenty news are heard at "
          "once, then one a second") {
  news_filter news;
  auto heard = [&news, n = 0](time_point now) mutable {
    return news.passes(std::to_string(++n), now);
  };
  for (int k = 0; k < 20; ++k)
    CHECK(heard(at(1s)));
  CHECK_FALSE(heard(at(1s)));
  CHECK(heard(at(2s)));
  CHECK_FALSE(heard(at(2s)));
}

TEST_CASE("the log has one line a period, with how often it has happened") {
  sampled_log log{1s};
  CHECK(log.add("it is late", at(5s)) == "it is late; 1 so far");
  CHECK_FALSE(log.add("it is late", at(5s)).has_value());
  CHECK_FALSE(log.add("it is loud", at(6s - 1ns)).has_value());
  CHECK(log.add("it is loud", at(6s)) == "it is loud; 4 so far");
}
