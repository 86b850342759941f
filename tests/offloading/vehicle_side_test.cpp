// Tests of a vehicle's side: what its policy learns of.
#include "offloading/vehicle_side.hpp"

#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

/// Asks nobody, and writes down what it learns, ten times a second.
struct observer final : local_policy {
  std::vector<cycle_outcome>& seen;
  explicit observer(std::vector<cycle_outcome>& outcomes) : seen{outcomes} {}

  local_decision decide(const local_context&) override {
    return as_it_is("only looks");
  }
  void observe(const cycle_outcome& outcome) override {
    seen.push_back(outcome);
  }
  double epoch_s() const override { return 0.1; }
  std::string_view name() const override { return "observer"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<observer>(*this);
  }
};

struct alone final : offloading::vehicle_port {
  std::multimap<time_point, std::uint64_t> due;
  std::vector<cycle_outcome> seen;

  void send(offloading::peer_id, offloading::to_provider) override {}
  void use(const service_result&) override {}
  void on_source(const service_name&, bool) override {}
  void wake_at(time_point t, std::uint64_t number) override {
    due.emplace(t, number);
  }

  offloading::vehicle_side side{setup(), *this, {}};

  offloading::vehicle_side_setup setup() {
    offloading::vehicle_side_setup all;
    all.station = 101;
    all.policy = std::make_unique<observer>(seen);
    all.services.push_back(in_vehicle(echo_service("one"), {}));
    return all;
  }
};

} // namespace

TEST_CASE("a policy with an epoch learns once an epoch what ran on board") {
  alone car;
  while (!car.due.empty() && car.due.begin()->first <= time_point{1s}) {
    const auto [t, number] = *car.due.begin();
    car.due.erase(car.due.begin());
    car.side.on_timer(number, t);
  }
  REQUIRE(car.seen.size() == 10);
  for (const auto& outcome : car.seen) {
    CHECK(!outcome.computed_at);
    CHECK(outcome.cycles == doctest::Approx(2)); // of 50 ms each
  }
}

namespace {

/// Knows nothing, and writes down what it is told.
struct place_diary final : quality_forecast {
  struct entry {
    provider_id provider;
    point at;
    bool late;
    bool is_offer;
  };
  std::vector<entry> told;

  expected_quality look(provider_id, std::string_view,
                        point at) const override {
    return {at.x_m / 1000, 0.02};
  }
  void learn(const seen_quality& x) override {
    told.push_back({x.provider, x.at, x.late, x.is_offer});
  }
};

/// Writes down what it is told of the way ahead.
struct looks_ahead final : local_policy {
  std::vector<provider_forecast>& seen;
  bool wants;
  looks_ahead(std::vector<provider_forecast>& all, bool asks)
      : seen{all}, wants{asks} {}

  local_decision decide(const local_context& context) override {
    seen.assign(context.forecasts.begin(), context.forecasts.end());
    return as_it_is("only looks");
  }
  bool needs_forecast() const override { return wants; }
  std::string_view name() const override { return "looks_ahead"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<looks_ahead>(*this);
  }
};

/// A car at (200, 0) that drives east at 10 m/s, and hears of one provider.
struct on_a_street {
  alone car; // whose port takes what the other side says
  std::shared_ptr<place_diary> places = std::make_shared<place_diary>();
  std::vector<provider_forecast> seen;

  void hear_offer(bool asks, duration on_the_way = 20ms) {
    offloading::vehicle_side_setup all;
    all.station = 101;
    all.policy = std::make_unique<looks_ahead>(seen, asks);
    all.services.push_back(in_vehicle(echo_service("one"), {}));
    all.path_ahead = [](const ego_state& ego) {
      return std::vector{ego.own.position, ego.own.position + point{50, 0},
                         ego.own.position + point{500, 0}};
    };
    all.forecast = places;
    offloading::vehicle_side side{std::move(all), car, time_point{}};
    side.on_motion({{101, time_point{}, {200, 0}, 0, 10, 0}, 200});
    service_offer offer{11, {500, 20}, {service_name{"one"}}};
    offer.created = time_point{1s};
    side.on_message(offloading::peer_id{1}, offer, time_point{1s + on_the_way});
  }
};

} // namespace

TEST_CASE_FIXTURE(on_a_street, "a policy that asks is told what to expect "
                               "along its path, and no other one") {
  hear_offer(true);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].provider == 11);
  REQUIRE(seen[0].along.size() == 2); // what is farther than 10 s is not told
  CHECK(seen[0].along[0].late == doctest::Approx(0.2));
  CHECK(seen[0].along[1].in_s == doctest::Approx(5));
  CHECK(seen[0].along[1].late == doctest::Approx(0.25));
  hear_offer(false);
  CHECK(seen.empty());
}

TEST_CASE_FIXTURE(on_a_street, "an offer tells of the place where it is heard, "
                               "also to who does not ask") {
  hear_offer(false);
  hear_offer(false, 2s);
  REQUIRE(places->told.size() == 2);
  CHECK(places->told[0].provider == 11);
  CHECK(places->told[0].at == point{200, 0});
  CHECK(places->told[0].is_offer);
  CHECK(!places->told[0].late);
  CHECK(places->told[1].late);
}
