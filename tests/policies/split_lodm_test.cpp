// The LODM "split": all services of a chain together.
#include "policies/algorithms/splits/split_search.hpp"
#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::comes_home;
using test::goes_to;

namespace {

constexpr double saved = 0.02; // J, of a cycle on board

std::unique_ptr<local_policy>
split_by(std::map<std::string, std::string, std::less<>> texts,
         duration max_response = 400ms, double margin = 0) {
  auto lodm = make_lodm("split");
  test::option_list options;
  options.texts = std::move(texts);
  options.texts["filter.name"] = "none";
  options.times["max_response"] = max_response;
  options.numbers["margin"] = margin;
  lodm->visit_options(options);
  CHECK(options.refused.empty());
  return lodm;
}

/// A chain of three services and two providers.
struct chain_of_three {
  static constexpr const char* names[]{"one", "two", "three"};
  std::vector<chain_link> chain;

  chain_of_three() {
    for (const auto* name : names) {
      auto& link = chain.emplace_back();
      link.service = name;
      link.needs.period = 50ms;
      link.on_board = {0.01, saved};
      link.times.period = chain.size() == 3 ? duration{50ms} : duration{0};
      link.times.on_board = time_law::exactly(10ms);
      for (const provider_id id : {1, 2}) {
        link.providers.push_back({.id = id, .cost = {0.01, saved / 2}});
        auto way = time_law::exactly(id == 1 ? 20ms : 60ms);
        link.times.at[id] = {way, time_law::exactly(2ms), way};
      }
    }
  }

  /// Decides about each service, in order, and does it.
  chain_split settle(local_policy& lodm) {
    for (auto& link : chain) {
      local_context context{.now = {},
                            .service = link.service,
                            .providers = link.providers,
                            .path = {}};
      context.current = link.place;
      context.chain = chain;
      const auto decision = lodm.decide(context);
      if (const auto to = goes_to(decision))
        link.place = to;
      else if (comes_home(decision))
        link.place = std::nullopt;
    }
    return places();
  }

  chain_split places() const {
    chain_split all;
    for (const auto& link : chain)
      all.push_back(link.place);
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(chain_of_three,
                  "with all the time in the world all services go where they "
                  "take the least energy") {
  const auto lodm = split_by({{"measure", "energy"}});
  for (auto& link : chain)
    link.providers[1].cost.energy_j = saved / 4;
  CHECK(settle(*lodm) == chain_split{2, 2, 2});
}

TEST_CASE_FIXTURE(chain_of_three,
                  "no more goes than the response time has room for") {
  // At home up to 10 + 10 + 50 + 10 + 10 ms; planning alone costs 32 ms more.
  CHECK(settle(*split_by({{"measure", "energy"}}, 60ms))
        == chain_split{{}, {}, {}});
  CHECK(settle(*split_by({{"measure", "energy"}}, 130ms))
        == chain_split{1, 1, 1}); // each asks the one before it there
}

TEST_CASE_FIXTURE(chain_of_three,
                  "a function that rests counts, and inputs that go up seldom "
                  "count as often as they do") {
  const auto with = [&](double resting_j, duration input_period) {
    auto x = *this;
    for (auto& link : x.chain) {
      link.resting_j = resting_j;
      link.times.input_period = input_period;
    }
    return x.settle(*split_by({{"measure", "energy"}}));
  };
  CHECK(with(0, {}) == chain_split{1, 1, 1});
  CHECK(with(0.6 * saved, {}) == chain_split{{}, {}, {}});
  CHECK(with(0.6 * saved, 100ms) == chain_split{1, 1, 1});
}

TEST_CASE("of very many splits not all are looked at") {
  std::vector<std::vector<service_place>> places(4, {{}, 1, 2, 3, 4, 5});
  CHECK(is_few(places));
  places[0].emplace_back(6);
  CHECK_FALSE(is_few(places));
  places.resize(70, std::vector<service_place>(2));
  CHECK_FALSE(is_few(places));
}

TEST_CASE_FIXTURE(chain_of_three,
                  "the least response time is at home where the "
                  "way is long") {
  const auto lodm = split_by({{"measure", "response"}});
  CHECK(settle(*lodm) == chain_split{{}, {}, {}});
  for (auto& link : chain)
    link.times.on_board = time_law::exactly(100ms);
  CHECK(settle(*split_by({{"measure", "response"}})) == chain_split{1, 1, 1});
}

TEST_CASE_FIXTURE(chain_of_three,
                  "a listed split is what runs elsewhere, as far "
                  "as it is offered") {
  const auto lodm = make_lodm("split");
  test::option_list options;
  options.texts = {{"filter.name", "none"}, {"search", "fixed"}};
  options.lists["offload"] = {"one", "three"};
  lodm->visit_options(options);
  CHECK(settle(*lodm) == chain_split{1, {}, 1});
}

TEST_CASE("the exact search takes the best split by its measure in every "
          "decision") {
  test::dice dice{7};
  for (int trial = 0; trial < 300; ++trial) {
    chain_of_three x;
    for (auto& link : x.chain) {
      link.times.on_board =
          time_law::exactly(from_seconds(dice.between(0.001, 0.08)));
      for (auto& there : link.providers) {
        there.cost.energy_j = saved * dice.between(0.01, 2);
        const auto way =
            time_law::exactly(from_seconds(dice.between(0.001, 0.08)));
        link.times.at[there.id] = {way, way, way};
      }
    }
    const auto limit = from_seconds(dice.between(0.1, 0.4));
    std::vector<service_times> times;
    for (const auto& link : x.chain)
      times.push_back(link.times);
    const auto late = [&](const chain_split& split) {
      return *predicted_response(times, split).quantile(0.99);
    };
    const auto energy = [&](const chain_split& split) {
      double sum = 0;
      for (std::size_t k = 0; k < split.size(); ++k) {
        constexpr auto per_s = 20.0;
        sum +=
            per_s
            * (split[k]
                   ? x.chain[k].providers[*split[k] == 1 ? 0 : 1].cost.energy_j
                   : saved);
      }
      return sum;
    };
    auto chosen =
        chain_of_three{x}.settle(*split_by({{"measure", "energy"}}, limit));
    auto quickest =
        chain_of_three{x}.settle(*split_by({{"measure", "response"}}));
    for (unsigned code = 0; code < 27; ++code) {
      const service_place places[]{{}, 1, 2};
      const chain_split split{places[code % 3], places[code / 3 % 3],
                              places[code / 9]};
      CHECK(late(quickest) <= late(split));
      if (late(split) <= limit)
        CHECK(energy(chosen) <= doctest::Approx(energy(split)));
    }
  }
}
