// What a service does unless it says otherwise, and what follows from its
// options.
#include "offloading/service.hpp"

#include "offloading/service_cycle.hpp"
#include "offloading/service_state.hpp"
#include "tests/support/at.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

/// Says no more than it has to.
struct taciturn final : offloading::vehicle_service {
  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<echo_function>();
  }
};

const session_id some_session{1, 101, "one", 7};

} // namespace

TEST_CASE("an input crosses the air as it is, the result in use only to who "
          "takes over") {
  const service_input input{some_session, at(1s), payload::of(echo{1}),
                            payload::of(echo{2})};
  const auto told = taciturn{}.encode_input(input, true);
  CHECK(told.session == some_session);
  CHECK(told.what.as<echo>()->number == 1);
  REQUIRE(told.in_use.as<echo>());
  CHECK(told.in_use.as<echo>()->number == 2);
  const auto short_of_it = taciturn{}.encode_input(input, false);
  CHECK(short_of_it.what.as<echo>()->number == 1);
  CHECK(short_of_it.in_use.empty());
}

TEST_CASE("results are believed, may follow each other, and nothing is told at "
          "the end") {
  const taciturn service;
  const auto x = payload::of(echo{echo::lie});
  const auto judged = service.make_judge()->judge(x, {}, at(1s));
  CHECK(judged.what.as<echo>()->number == echo::lie);
  CHECK_FALSE(judged.refused);
  CHECK_FALSE(judged.useless);
  CHECK(service.continues(x, payload::of(echo{echo::jump}), at(1s)));
  CHECK(service.termination_message({}, at(1s), {}).empty());
  CHECK(echo_at_provider{}.termination_message({}, at(1s)).empty());
}

TEST_CASE("a service keeps its name and options on both sides, and is made "
          "there") {
  auto service = echo_service("one");
  station_id made_for = 0;
  service.in_vehicle = [&](const offloading::vehicle_context& vehicle) {
    made_for = vehicle.station;
    return std::make_shared<taciturn>();
  };
  const auto own = in_vehicle(service, {.station = 101});
  CHECK(made_for == 101);
  CHECK(own.name == service_name{"one"});
  CHECK(own.options.period == echo_options().period);
  REQUIRE(own.own);
  const auto there = at_provider(service, {9001, {}});
  CHECK(there.name == service_name{"one"});
  CHECK(there.options.limits.max_latency == 50ms);
  REQUIRE(there.here);
}

TEST_CASE("what a requester needs of a service follows from its options and "
          "the computer") {
  auto own = in_vehicle(echo_service("one"), {});
  own.options.input_period = 100ms;             // two cycles of 50 ms
  own.options.compute = {.run_time_mean = 20ms, // at 3 GHz
                         .run_time_sd = {},
                         .run_time_max = {},
                         .demand = {},
                         .input_octets = 25'000,
                         .overhead_j = 0.5};
  const computer_options slow{.clock_ghz = 2, .uplink_mbps = 10};
  const offloading::service_state state{own, slow, at(1s)};
  CHECK(state.needs.period == 50ms);
  CHECK(state.needs.max_latency == 50ms);
  CHECK(state.needs.max_interarrival == 100ms);
  CHECK(state.on_board.time_s == doctest::Approx{0.03});
  CHECK(state.offloaded.time_s == doctest::Approx{0.02}); // the way alone
  CHECK(state.offloaded.energy_j == doctest::Approx{0.2 * 0.02 / 2 + 0.5});
  CHECK(state.since == at(1s));
}

TEST_CASE("the worst response through a provider is that of the oldest input, "
          "the longest gap, and the own function's run time") {
  auto options = echo_options();
  options.limits = {50ms, 100ms, 500ms};
  options.compute.run_time_max = 45ms;
  CHECK(offloading::worst_response(options) == 645ms);
  options.shared_response = 70ms;
  CHECK(offloading::worst_response(options) == 670ms);
  options.shared_response = duration::max();
  CHECK(offloading::worst_response(options) == duration::max());
  options.shared_response.reset();
  CHECK(offloading::worst_response(offloading::on({.clock_ghz = 1.5}, options))
        == 650ms); // its cycles last no longer than the period
  options.limits.max_input_age = duration::max(); // no limit
  CHECK(offloading::worst_response(options) == duration::max());
}

TEST_CASE("an own function's first result of an input takes a period and its "
          "run time, and a result of each input its run time alone") {
  auto options = echo_options();
  options.period = 50ms;
  options.compute.run_time_max = 45ms;
  CHECK(offloading::own_response(options) == 95ms);
  options.per_input = true;
  CHECK(offloading::own_response(options) == 45ms);
}

TEST_CASE("what a scene allows of a result is what the longest gap and the own "
          "function leave, never more than the cap, and nothing below the "
          "floor") {
  auto options = echo_options();
  options.limits = {200ms, 100ms, 500ms}; // the first one is the cap
  options.compute.run_time_max = 45ms;
  options.latency_floor = 30ms;
  CHECK(offloading::limits_in_scene(options, 645ms)
        == messages::qos_limits{200ms, 100ms, 500ms});
  CHECK(offloading::limits_in_scene(options, 644ms)
        == messages::qos_limits{200ms, 100ms, 499ms});
  CHECK(offloading::limits_in_scene(options, 300ms)
        == messages::qos_limits{155ms, 100ms, 155ms});
  CHECK(offloading::limits_in_scene(options, 175ms)
        == messages::qos_limits{30ms, 100ms, 30ms});
  CHECK_FALSE(offloading::limits_in_scene(options, 175ms - 1ns));
  for (duration safe{0}; safe < 2s; safe += 7ms)
    if (const auto now = offloading::limits_in_scene(options, safe)) {
      CHECK(now->max_latency <= 200ms);
      CHECK(now->max_latency >= 30ms);
      CHECK(now->max_input_age + now->max_interarrival + 45ms <= safe);
    }
}

TEST_CASE("the phase of an own function is drawn within its period, by its "
          "name") {
  const random_stream noise{1, "vehicle"};
  const auto one = own_cycle(in_vehicle(echo_service("one"), {}), 101, noise);
  const auto two = own_cycle(in_vehicle(echo_service("two"), {}), 101, noise);
  CHECK(one.session == session_id{0, 101, "one", 0});
  CHECK(one.period == 50ms);
  CHECK(one.phase >= 0ms);
  CHECK(one.phase < 50ms);
  CHECK(one.phase != two.phase);
  CHECK(one.function != nullptr);
}
