// Tests of the kinds of services: names, options, functions.
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "tests/support/echo_service.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/option_list.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/binary_deserializer.hpp>
#include <caf/binary_serializer.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;

namespace {

service_world one_street() {
  auto world = std::make_shared<streets>();
  world->map = road_map{"map", {}, {toy::straight("lane", {0, 0}, {1000, 0})}};
  world->routes.push_back(
      world->map.make_route("street", std::vector<std::string>{"lane"}, false));
  return {.streets = std::move(world), .where = in_ulm()};
}

/// The service of a name, in vehicle 101.
std::shared_ptr<offloading::vehicle_service>
in_vehicle(std::string_view name, const service_world& world = one_street()) {
  return make_service_type(name)->in(world).in_vehicle({.station = 101});
}

std::shared_ptr<offloading::vehicle_service> planning_in_vehicle() {
  return in_vehicle("trajectory_planning");
}

/// What becomes of a payload whose bytes break on the way.
payload broken(const std::string& type, std::size_t size) {
  caf::byte_buffer wire;
  caf::binary_serializer sink{nullptr, wire};
  REQUIRE(sink.apply(type));
  REQUIRE(sink.apply(std::vector<std::byte>(size, std::byte{0xa5})));
  payload p;
  caf::binary_deserializer source{nullptr, wire};
  REQUIRE(source.apply(p));
  return p;
}

plan_request standing_at(double s_m, time_point at) {
  plan_request ask;
  ask.way = "street";
  ask.from.at = at;
  ask.from.s_m = s_m;
  return ask;
}

} // namespace

TEST_CASE("both services are there, under their names") {
  const auto names = service_type_names();
  CHECK(std::ranges::is_sorted(names));
  for (const auto name : {"cabin_climate", "trajectory_planning"})
    CHECK(std::ranges::find(names, name) != names.end());
  for (const auto name : names) {
    REQUIRE(make_service_type(name));
    CHECK(make_service_type(name)->name() == name);
    CHECK_NOTHROW(service_name{name});
  }
}

TEST_CASE("there is no service of an unknown name") {
  CHECK(!make_service_type(""));
  CHECK(!make_service_type("trajectory"));
  CHECK(!make_service_type("Cabin_climate"));
}

TEST_CASE("every kind lists its options once, defaults within their ranges, "
          "the common ones first") {
  for (const auto name : service_type_names()) {
    CAPTURE(name);
    option_list options;
    make_service_type(name)->visit_options(options);
    CHECK(options.refused.empty());
    for (const auto key :
         {"max_latency", "max_interarrival", "period", "input_period",
          "compute.run_time_mean", "compute.run_time_sd",
          "compute.run_time_max", "compute.input_octets"})
      CHECK(options.names.contains(key));
  }
}

TEST_CASE("trajectory planning promises what the paper chose") {
  const auto kind = make_service_type("trajectory_planning");
  CHECK(kind->options.limits.max_latency == 50ms);
  CHECK(kind->options.limits.max_interarrival == 100ms);
  CHECK(kind->options.period == 50ms);
  CHECK(kind->options.compute.run_time_mean == 5500us);
  CHECK(kind->options.compute.run_time_sd == 2ms);
}

TEST_CASE("a slow computer takes longer, and never longer than a period") {
  const auto usual = make_service_type("trajectory_planning")->options;
  const auto same = on(computer_options{}, usual);
  CHECK(same.compute.run_time_mean == usual.compute.run_time_mean);
  CHECK(same.compute.run_time_max == usual.compute.run_time_max);
  const auto slow = on(computer_options{.clock_ghz = 1.5}, usual);
  CHECK(slow.compute.run_time_mean == 11ms);
  CHECK(slow.compute.run_time_sd == 4ms);
  CHECK(slow.compute.run_time_max == usual.period);
  const auto fast = on(computer_options{.clock_ghz = 6}, usual);
  CHECK(fast.compute.run_time_mean == 2750us);
  CHECK(fast.compute.run_time_max == 22500us);
  CHECK(demand_of(slow.compute) == demand_of(usual.compute));
}

TEST_CASE("at a provider a service asks as much more than planning as on "
          "board, unless it says what was measured") {
  const auto asks = [](std::string_view name) {
    return demand_of(make_service_type(name)->options.compute);
  };
  CHECK(asks("trajectory_planning") == 1);
  CHECK(asks("cabin_climate") == doctest::Approx(0.2 / 5.5));
  CHECK(asks("synthetic_load") == doctest::Approx(60 / 5.5));
  auto measured = make_service_type("synthetic_load")->options.compute;
  measured.demand = 2;
  CHECK(demand_of(measured) == 2);
}

TEST_CASE("cabin climate is slow and patient") {
  const auto kind = make_service_type("cabin_climate");
  CHECK(kind->options.limits.max_latency == 2s);
  CHECK(kind->options.limits.max_interarrival == 5s);
  CHECK(kind->options.period == 1s);
}

TEST_CASE("every kind keeps its own limits at home") {
  for (const auto name : service_type_names()) {
    CAPTURE(name);
    const auto common = make_service_type(name)->options;
    CHECK(common.compute.run_time_max <= common.period);
    CHECK(common.compute.run_time_mean <= common.compute.run_time_max);
    CHECK(common.period <= common.limits.max_interarrival);
  }
}

TEST_CASE("an unknown planner is refused") {
  option_list options;
  options.texts = {{"planner.name", "crystal_ball"}};
  make_service_type("trajectory_planning")->visit_options(options);
  CHECK(options.refused.contains("planner.name"));
}

TEST_CASE("a function without proper input gives no result") {
  for (const auto name : service_type_names()) {
    CAPTURE(name);
    auto function = in_vehicle(name)->make_function();
    const auto result_of = [&](payload what) {
      return function->run(time_point{1s}, {{}, time_point{1s}, what}).what;
    };
    CHECK(result_of({}).type().empty());
    CHECK(result_of(payload::of(echo{1})).type().empty());
    for (const auto type : {"plan_request", "climate_ask"})
      for (std::size_t size = 0; size < 200; ++size)
        if (size != 32) // four numbers are a climate question
          CHECK(result_of(broken(type, size)).type().empty());
  }
}

namespace {

/// The plan in a result, if there is one.
std::shared_ptr<const trajectory>
planned(const offloading::service_output& result) {
  return result.what.as<trajectory>();
}

} // namespace

TEST_CASE("a plan begins when its cycle begins, where the vehicle is") {
  const auto function = planning_in_vehicle()->make_function();
  const time_point t{3s};
  const auto ask = standing_at(100, t);
  const auto plan = planned(function->run(t, {{}, t, payload::of(ask)}));
  REQUIRE(plan);
  REQUIRE(!plan->empty());
  CHECK(plan->start == t);
  CHECK(distance_m(plan->points.front().at, {100, 0}) < 0.01);
  CHECK(plan->points.back().s_m > 110);
}

TEST_CASE("a plan goes on from the one before") {
  const auto function = planning_in_vehicle()->make_function();
  const auto ask = standing_at(100, time_point{3s});
  const service_input old_input{{}, time_point{3s}, payload::of(ask)};
  const auto first = planned(function->run(time_point{3s}, old_input));
  const auto next = planned(function->run(time_point{3050ms}, old_input));
  REQUIRE(first);
  REQUIRE(next);
  CHECK(next->start == time_point{3050ms});
  CHECK(distance_m(next->points.front().at, first->at(time_point{3050ms}).at)
        < 1e-6);
}

TEST_CASE("on a way that is not on the map there is no plan") {
  const auto function = planning_in_vehicle()->make_function();
  auto ask = standing_at(100, time_point{3s});
  ask.way = "lane"; // a lane is no route
  CHECK(function->run(time_point{3s}, {{}, time_point{3s}, payload::of(ask)})
            .what.type()
            .empty());
}

TEST_CASE("two functions of one kind know nothing of each other") {
  const auto planning = planning_in_vehicle();
  const auto a = planning->make_function();
  const auto b = planning->make_function();
  const time_point t{3s};
  a->run(t, {{}, t, payload::of(standing_at(100, t))});
  const auto plan =
      planned(b->run(t, {{}, t, payload::of(standing_at(500, t))}));
  REQUIRE(plan);
  CHECK(plan->points.front().s_m == doctest::Approx(500));
}

TEST_CASE(
    "a vehicle understands what is suggested to it, and nothing else as a "
    "plan") {
  const auto world = one_street();
  const auto planning = in_vehicle("trajectory_planning", world);
  const trajectory plan{
      time_point{3s},
      {{0, 100, {100, 0}, 0, 0, 8, 0}, {3, 124, {124, 0}, 0, 0, 8, 0}}};
  const auto suggested_to = [&](station_id whom) {
    std::vector<maneuver_waypoint> room;
    etsi::mcm message;
    REQUIRE(make_suggestion({9001, {150, 50}, whom, {7, 1}}, plan, *in_ulm(),
                            room, message));
    return encoded(message);
  };
  plan_request ask;
  ask.way = world.streets->routes.front()->name();
  ask.from.s_m = 100;
  ask.own = {101, time_point{3s}, {100, 0}, 0, 8};
  const auto means = [&](const payload& result) {
    return planning->make_judge()
        ->judge(result, {{}, ask.own.at, payload::of(ask)}, time_point{3020ms})
        .what.as<trajectory>();
  };
  CHECK(means(payload::of(suggested_to(101))));
  CHECK(!means(payload::of(suggested_to(102))));
  auto cut = suggested_to(101);
  cut.octets.resize(cut.octets.size() / 2);
  CHECK(!means(payload::of(cut)));
  CHECK(!means(payload::of(its_pdu{})));
  CHECK(!means({}));
  CHECK(!means(payload::of(echo{1})));
  CHECK(!means(payload::of(pdu_of(ask.own))));
  CHECK(!means(planning->termination_message({}, ask.own.at, ask.own)));
  // Nor what begins elsewhere, beside the vehicle or ahead of it, or with
  // another speed.
  for (const auto off : {point{3, 0}, point{60, 0}, point{0, 2}}) {
    ask.own.position = point{100, 0} + off;
    CHECK(!means(payload::of(suggested_to(101))));
  }
  ask.own.position = {100, 0};
  ask.own.speed_mps = 5;
  CHECK(!means(payload::of(suggested_to(101))));
}

TEST_CASE("planning ends with an MCM of who ends it") {
  const auto planning =
      make_service_type("trajectory_planning")->in(one_street());
  const auto vehicle = planning.in_vehicle({.station = 101});
  const cam own{101, time_point{3s}, {100, 0}, 0, 8};
  service_end end{{11, 101, "trajectory_planning", 0x10007},
                  end_reason::qos_gap,
                  side::requester};

  const auto word =
      vehicle->termination_message(end, own.at, own).as<its_pdu>();
  REQUIRE(word);
  const auto said = message_in<etsi::mcm>(*word);
  REQUIRE(said);
  CHECK(said->header.station == 101);
  const auto& user =
      std::get<etsi::road_user_container>(said->body.parameters.maneuver.value);
  REQUIRE(user.advice_response);
  CHECK(user.advice_response->maneuver_id == 7);
  CHECK(user.advice_response->followed == etsi::maneuver_response::reject);

  const auto provider =
      planning.at_provider({.station = 9001, .position = {150, 50}});
  const std::pair<end_reason, etsi::termination_status> reasons[]{
      {end_reason::left_area, etsi::termination_status::regular_end},
      {end_reason::shutdown, etsi::termination_status::regular_end},
      {end_reason::cam_timeout, etsi::termination_status::abort_by_timeout},
      {end_reason::no_data, etsi::termination_status::abort_by_timeout},
      {end_reason::peer_lost, etsi::termination_status::reason_unknown}};
  for (const auto& [why, status] : reasons) {
    end.reason = why;
    const auto pdu = provider->termination_message(end, own.at).as<its_pdu>();
    REQUIRE(pdu);
    const auto told = message_in<etsi::mcm>(*pdu);
    REQUIRE(told);
    CHECK(told->header.station == 9001);
    const auto& to = std::get<etsi::suggested_maneuver_container>(
        told->body.parameters.maneuver.value);
    CHECK(to.target == 101);
    REQUIRE(to.maneuver);
    CHECK(to.maneuver->maneuver_id == 7);
    CHECK(std::get<etsi::termination_status>(to.maneuver->parameters.value)
          == status);
  }
}

TEST_CASE("other services say no farewell") {
  const auto climate = make_service_type("cabin_climate")->in(one_street());
  const cam own{101, time_point{3s}, {}};
  CHECK(climate.in_vehicle({.station = 101})
            ->termination_message({}, own.at, own)
            .type()
            .empty());
  CHECK(
      climate.at_provider({})->termination_message({}, own.at).type().empty());
}

TEST_CASE_FIXTURE(virtual_world, "the vehicle itself uses its plans") {
  const auto vehicle = listen<vehicle_actor>();
  const auto kind = make_service_type("trajectory_planning");
  CHECK(caf::actor_cast<caf::actor>(
            kind->spawn_client({system(), vehicle.handle}).actor)
        == caf::actor_cast<caf::actor>(vehicle.handle));
}
