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
