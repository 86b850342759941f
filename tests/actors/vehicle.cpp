// Tests of the vehicle: it drives, is seen, and never is without a plan.
#include "actors/vehicle.hpp"

#include "actors/planning/plan_request.hpp"
#include "messages/v2x/coordination.hpp"
#include "planners/lane_follow.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/each_number.hpp"
#include "tests/support/on_air.hpp"
#include "tests/support/toy_streets.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

/// One vehicle on a straight street (limit 10 m/s), starting 100 m along it.
struct driving_world : virtual_world {
  static constexpr station_id station = 101;
  probe<road_actor> road = listen<road_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  probe<onboard_requester_actor> requester = listen<onboard_requester_actor>();
  probe<link_actor> near = listen<link_actor>();
  probe<link_actor> distant = listen<link_actor>();
  probe<requester_manager_actor> manager = listen<requester_manager_actor>();
  const double start_speed_mps;
  const std::optional<v2x_options> v2x;
  route_ptr way = street();
  lane_follow planner{way, {}};
  vehicle_actor car = spawn();
  running_service source{0, station, "trajectory_planning", 0};
  std::uint64_t cycle = 0;

  explicit driving_world(double starts_at_mps = 0,
                         std::optional<v2x_options> says = v2x_options{})
      : start_speed_mps{starts_at_mps}, v2x{std::move(says)} {
    settle();
  }

  static route_ptr street() {
    const road_map map{
        "street", {}, {toy::straight("street", {0, 0}, {1000, 0})}};
    return map.make_route("street", std::vector<std::string>{"street"}, false);
  }

  vehicle_actor spawn() {
    vehicle_setup setup;
    setup.station = station;
    setup.way = way;
    setup.start_s_m = 100;
    setup.start_speed_mps = start_speed_mps;
    setup.v2x = v2x;
    setup.where = in_ulm();
    setup.fresh_limit = 200ms;
    setup.track_period = 100ms;
    setup.antennas = {{near.handle, {150, 0}, 100},
                      {distant.handle, {500, 0}, 100}};
    setup.road = road.handle;
    setup.recorder = recorder.handle;
    setup.spawn_requester = [this](const vehicle_actor&) {
      return requester.handle;
    };
    return own(spawn_vehicle(system(), std::move(setup)));
  }

  /// Plans from where the car is, as a service would do.
  trajectory plan() {
    const auto report = last_report();
    planning_input from;
    from.at = report_time();
    from.s_m = report.s_m;
    from.d_m = report.state.at.y_m;
    from.speed_mps = report.state.speed_mps;
    from.accel_mps2 = report.state.accel_mps2;
    trajectory out;
    planner.plan(report_time(), from, nullptr, out);
    return out;
  }
  void give(trajectory t, time_point created) {
    tell(car,
         service_result{source, ++cycle, created, payload::of(std::move(t))});
  }
  /// The same as a provider would do.
  its_pdu encoded_suggestion(const trajectory& t, station_id whom) {
    std::vector<maneuver_waypoint> room;
    etsi::mcm message;
    REQUIRE(make_suggestion({9001, {150, 0}, whom, {7, 1}}, t, *in_ulm(), room,
                            message));
    return encoded(message);
  }
  void suggest(const trajectory& t, station_id whom) {
    tell(car, service_result{source, ++cycle, now(),
                             payload::of(encoded_suggestion(t, whom))});
  }
  /// Drives with a new plan every 50 ms.
  void drive(duration d) {
    trajectory last = plan();
    for (const auto end = now() + d; now() < end; run_for(50ms)) {
      planning_input from;
      const auto p = last.at(now());
      from.at = now();
      from.s_m = p.s_m;
      from.speed_mps = p.speed_mps;
      from.accel_mps2 = p.accel_mps2;
      trajectory next;
      planner.plan(now(), from, &last, next);
      last = next;
      give(next, now());
    }
  }

  // -- what it sent ---------------------------------------------------------

  using cpm = etsi::tr103562::cpm;
  std::vector<air_record> air() const { return recorder->all<air_record>(); }
  std::vector<its_pdu> air_pdus() const {
    std::vector<its_pdu> all;
    for (const auto& record : air())
      all.push_back(record.message);
    return all;
  }
  template <class Message>
  std::vector<time_point> air_times() const {
    std::vector<time_point> all;
    for (const auto& record : air())
      if (message_in<Message>(record.message))
        all.push_back(record.at);
    return all;
  }

  motion_report last_report() const {
    return road->all<motion_report>().back();
  }
  time_point report_time() const { return road->times<motion_report>().back(); }
  double fastest_mps() const {
    double v = 0;
    for (const auto& r : road->all<motion_report>())
      v = std::max(v, r.state.speed_mps);
    return v;
  }
  drive_record whole_drive() const {
    drive_record sum;
    for (const auto& r : recorder->all<drive_record>()) {
      CHECK(r.station == station);
      sum.plans.add(r.plans);
      sum.ride.add(r.ride);
    }
    return sum;
  }
  safety_record total() const {
    safety_record sum;
    for (const auto& r : recorder->all<safety_record>()) {
      sum.driven += r.driven;
      sum.without_fresh_plan += r.without_fresh_plan;
      sum.off_road += r.off_road;
      sum.max_plan_age = std::max(sum.max_plan_age, r.max_plan_age);
    }
    return sum;
  }
};

/// The same, starting at the speed limit.
struct flying_start_world : driving_world {
  flying_start_world() : driving_world{10} {}

  /// What a vehicle does before its first plan and after.
  double slowest_mps() const {
    auto v = start_speed_mps;
    for (const auto& r : road->all<motion_report>())
      v = std::min(v, r.state.speed_mps);
    return v;
  }
};

void tell_of_a_car(driving_world& world) {
  world.tell(world.car,
             perception{world.now(), {}, {{{150, 1}, 0, 3, 0, 4.5, 1.8}}});
}

void kill_antennas(driving_world& world) {
  world.kill(world.near.handle);
  world.kill(world.distant.handle);
}

} // namespace

TEST_CASE_FIXTURE(driving_world, "a vehicle begins standing, with a plan") {
  CHECK(last_report().station == station);
  CHECK(last_report().s_m == 100);
  CHECK(last_report().state.speed_mps == 0);
  run_for(60s);
  CHECK(fastest_mps() == 0);
  CHECK(distance_m(last_report().state.at, {100, 0}) < 1e-6);
}

TEST_CASE_FIXTURE(flying_start_world,
                  "a vehicle that starts driving keeps its speed until the "
                  "first plan comes, and then") {
  CHECK(last_report().state.speed_mps == 10);
  CHECK(last_report().s_m == 100);
  run_for(500ms);
  CHECK(slowest_mps() == doctest::Approx(10).epsilon(0.005));
  CHECK(last_report().s_m
        == doctest::Approx(100 + 10 * to_seconds(report_time() - time_point{}))
               .epsilon(0.001));
  drive(5s);
  CHECK(slowest_mps() == doctest::Approx(10).epsilon(0.005));
  CHECK(fastest_mps() == doctest::Approx(10).epsilon(0.005));
}

TEST_CASE_FIXTURE(flying_start_world, "a vehicle that starts driving and gets "
                                      "no plan stops safely") {
  run_for(20s);
  CHECK(last_report().state.speed_mps == 0);
  CHECK(last_report().s_m < 150); // 2 s as before, then 4 m/s2
  CHECK(total().off_road == 0ms);
}

TEST_CASE_FIXTURE(driving_world, "the road hears of the vehicle at once, then "
                                 "every 50 ms, and whom to answer") {
  CHECK(road->times<motion_report>().front() == time_point{});
  run_for(10s);
  const auto times = road->times<motion_report>();
  REQUIRE(times.size() > 199);
  for (std::size_t k = 2; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 50ms);
  CHECK(road->seconds<vehicle_actor>().front() == car);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle follows its plan") {
  const auto wanted = plan();
  give(wanted, now());
  run_for(4s);
  const auto there = wanted.at(report_time());
  CHECK(there.speed_mps > 3);
  CHECK(last_report().state.speed_mps
        == doctest::Approx(there.speed_mps).epsilon(0.05));
  CHECK(distance_m(last_report().state.at, there.at) < 0.5);
  CHECK(last_report().s_m == doctest::Approx(there.s_m).epsilon(0.005));
}

TEST_CASE_FIXTURE(driving_world,
                  "when plans cease the vehicle stops on its own, on the "
                  "road") {
  drive(10s);
  CHECK(last_report().state.speed_mps > 8);
  run_for(20s);
  CHECK(last_report().state.speed_mps == 0);
  const auto s_m = last_report().s_m;
  CHECK(std::abs(last_report().state.at.y_m) < 0.2);
  CHECK(total().off_road == 0ms);
  run_for(60s);
  CHECK(last_report().s_m == s_m);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle that has stopped goes on when "
                                 "plans come again") {
  drive(5s);
  run_for(20s);
  REQUIRE(last_report().state.speed_mps == 0);
  drive(5s);
  CHECK(last_report().state.speed_mps > 3);
}

TEST_CASE_FIXTURE(driving_world, "an older plan does not replace a newer one") {
  run_for(1s);
  give(plan(), now());
  auto standing = trajectory{now() - 1ns, {{}, {}}};
  standing.points[0].at = standing.points[1].at = {100, 0};
  standing.points[0].s_m = standing.points[1].s_m = 100;
  standing.points[1].t_s = 10;
  give(standing, now() - 1ns);
  run_for(3s);
  CHECK(last_report().state.speed_mps > 2);
}

TEST_CASE_FIXTURE(driving_world, "what is no plan is no plan") {
  run_for(1s);
  give(plan(), now());
  run_for(100ms);
  give({}, now()); // without a point
  tell(car, service_result{{}, 9, now(), {}});
  tell(car, service_result{{}, 9, now(), payload::of(plan_request{})});
  auto of_another_time = plan();
  of_another_time.start += 1s;
  give(of_another_time, now());
  auto no_number = plan();
  no_number.points[3].at.x_m = std::nan("");
  give(no_number, now());
  run_for(3s);
  CHECK(last_report().state.speed_mps > 2);
}

TEST_CASE_FIXTURE(driving_world, "a suggested plan is followed like one of "
                                 "its own") {
  run_for(1s);
  const auto wanted = plan();
  suggest(wanted, station);
  run_for(4s);
  const auto there = wanted.at(report_time());
  CHECK(there.speed_mps > 3);
  CHECK(distance_m(last_report().state.at, there.at) < 0.5);
}

TEST_CASE_FIXTURE(driving_world, "what is suggested to another station is not "
                                 "followed") {
  run_for(1s);
  suggest(plan(), station + 1);
  run_for(4s);
  CHECK(fastest_mps() == 0);
}

TEST_CASE_FIXTURE(driving_world, "a termination, a word and other messages "
                                 "are no plans") {
  run_for(1s);
  give(plan(), now());
  run_for(100ms);
  const suggestion what{9001, {150, 0}, station, {7, 1}};
  const cam own{station, now(), {100, 0}};
  for (const auto& pdu :
       {encoded(make_termination(
            what, now(), etsi::termination_status::regular_end, *in_ulm())),
        encoded(make_word({own, {}, nullptr, {}}, {}, *in_ulm())), pdu_of(own),
        pdu_of(own, {}), its_pdu{}})
    tell(car, service_result{source, ++cycle, now(), payload::of(pdu)});
  run_for(3s);
  CHECK(last_report().state.speed_mps > 2);
  CHECK(!is_gone(car));
}

TEST_CASE_FIXTURE(driving_world, "whatever octets come as plans, a vehicle "
                                 "goes on as planned") {
  run_for(1s);
  const auto wanted = plan();
  give(wanted, now());
  const auto good = encoded_suggestion(wanted, station);
  REQUIRE(!good.octets.empty());
  dice d{1};
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(d.between(0, static_cast<double>(n)));
  };
  for (auto k = 0; k < 3000; ++k) {
    auto pdu = good;
    if (k % 3 == 0)
      for (auto& octet : pdu.octets)
        octet = static_cast<std::byte>(below(256));
    if (k % 2 == 0)
      pdu.octets.resize(below(pdu.octets.size()));
    else if (k % 3 != 0)
      pdu.octets.resize(2 + below(6)); // cut off behind its header
    tell(car, service_result{source, ++cycle, now(), payload::of(pdu)});
    if (k % 10 == 0)
      run_for(10ms);
  }
  CHECK(!is_gone(car));
  const auto there = wanted.at(report_time());
  CHECK(distance_m(last_report().state.at, there.at) < 0.5);
}

TEST_CASE_FIXTURE(driving_world, "whatever numbers a suggestion holds, a "
                                 "vehicle drives like a car, and goes on with "
                                 "the next good plan") {
  drive(5s);
  dice d{2};
  const auto good = *message_in<etsi::mcm>(encoded_suggestion(plan(), station));
  for (auto k = 0; k < 1000; ++k) {
    auto message = good;
    each_number(message.body, [&]<class N>(N& x) {
      if (d.between(0, 1) < 0.02)
        x.value = static_cast<typename N::number>(d.between(
            static_cast<double>(N::low), static_cast<double>(N::high) + 1));
    });
    tell(car,
         service_result{source, ++cycle, now(), payload::of(encoded(message))});
    if (k % 10 == 0)
      run_for(10ms);
    REQUIRE(!is_gone(car));
  }
  CHECK(std::isfinite(last_report().state.at.x_m));
  CHECK(std::isfinite(last_report().state.at.y_m));
  CHECK(last_report().state.speed_mps < 30);
  run_for(10s); // it stops, if it has to
  drive(5s);
  CHECK(last_report().state.speed_mps > 3);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle asks for plans where they are "
                                 "made, whenever it has perceived") {
  tell(car, perception{});
  CHECK(manager->entries().empty());
  tell(car, manager.handle);
  run_for(1s);
  const perception seen{now(), 170.0, {{{150, 1}, 0, 3, 0, 4.5, 1.8}}};
  tell(car, seen);
  REQUIRE(manager->count<service_input>() == 1);
  const auto input = manager->all<service_input>().front();
  CHECK(input.at == now());
  const auto request = input.what.as<plan_request>();
  REQUIRE(request);
  CHECK(request->way == "street");
  CHECK(request->from.s_m == doctest::Approx(100));
  CHECK(request->from.speed_mps == 0);
  CHECK(request->seen.at == seen.at);
  CHECK(request->seen.stop_at_m == seen.stop_at_m);
  REQUIRE(request->seen.objects.size() == 1);
  CHECK(request->seen.objects[0].centre == seen.objects[0].centre);
}

// -- being seen --------------------------------------------------------------

TEST_CASE_FIXTURE(driving_world, "the own requester hears of the motion every "
                                 "100 ms") {
  run_for(10s);
  const auto times = requester->times<ego_state>();
  REQUIRE(times.size() == 100);
  for (std::size_t k = 1; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 100ms);
  drive(5s);
  run_for(10ms);
  const auto own = requester->all<ego_state>().back();
  CHECK(own.own.station == station);
  CHECK(own.own.at == requester->times<ego_state>().back());
  CHECK(own.own.speed_mps > 3);
  CHECK(own.own.position.x_m == doctest::Approx(own.s_m).epsilon(0.001));
}

TEST_CASE_FIXTURE(driving_world,
                  "only providers in range hear a CAM, and whom to answer") {
  run_for(10s);
  CHECK(messages_in<etsi::cam>(near->all<its_pdu>()).size() == 10);
  CHECK(distant->entries().empty());
  CHECK(near->seconds<requester_actor>().front()
        == requester_actor{requester.handle});
}

TEST_CASE_FIXTURE(driving_world, "a vehicle at rest sends a CAM a second, and "
                                 "a CPM") {
  run_for(10s);
  for (const auto& times : {air_times<etsi::cam>(), air_times<cpm>()}) {
    REQUIRE(times.size() == 10);
    for (std::size_t k = 1; k < times.size(); ++k)
      CHECK(times[k] - times[k - 1] == 1s);
  }
}

TEST_CASE_FIXTURE(flying_start_world,
                  "a vehicle sends a CAM as soon as it has moved 4 m, of its "
                  "own motion") {
  drive(10s);
  const auto all = air();
  std::vector<cam> said;
  for (const auto& record : all)
    if (message_in<etsi::cam>(record.message)) {
      said.push_back(motion_in(record.message, record.at));
      CHECK(said.back().at == record.at);
      CHECK(said.back().station == station);
    }
  REQUIRE(said.size() > 15);
  for (std::size_t k = 1; k < said.size(); ++k) {
    const auto moved_m = distance_m(said[k].position, said[k - 1].position);
    CHECK(moved_m > 4 - 0.02);
    CHECK(moved_m < 4 + 0.1 * 10 + 0.02); // it looks every 100 ms
  }
  const auto own = requester->all<ego_state>().back();
  CHECK(said.back().speed_mps
        == doctest::Approx(own.own.speed_mps).epsilon(0.01));
  CHECK(own.own.position.x_m - said.back().position.x_m < 5);
}

TEST_CASE("by the clock, CAMs and CPMs go out at 10 Hz") {
  v2x_options steady;
  steady.cam = steady.cpm = "fixed_10hz";
  driving_world world{0, steady};
  world.run_for(10s);
  CHECK(world.air_times<etsi::cam>().size() == 100);
  CHECK(world.air_times<driving_world::cpm>().size() == 100);
  CHECK(world.near->count<its_pdu>() == 200);
}

TEST_CASE("who is not connected sends nothing, and still tells its requester") {
  driving_world world{0, std::nullopt};
  world.run_for(10s);
  CHECK(world.near->entries().empty());
  CHECK(world.air().empty());
  CHECK(world.requester->count<ego_state>() == 100);
}

TEST_CASE("who is to send no CPMs sends CAMs alone") {
  v2x_options mute;
  mute.cpm = "off";
  driving_world world{0, mute};
  tell_of_a_car(world);
  world.run_for(5s);
  CHECK(world.air_times<etsi::cam>().size() == 5);
  CHECK(world.air().size() == 5);
}

TEST_CASE_FIXTURE(driving_world, "what a vehicle perceives it tells in CPMs, "
                                 "something new at once") {
  run_for(1500ms);
  const auto before = air_times<cpm>().size();
  tell_of_a_car(*this);
  run_for(100ms);
  const auto all = messages_in<cpm>(air_pdus());
  REQUIRE(all.size() == before + 1);
  const auto seen = read_cpm(all.back(), *in_ulm(), now());
  REQUIRE(seen);
  CHECK(seen->from == station);
  REQUIRE(seen->objects.size() == 1);
  CHECK(distance_m(seen->objects[0].centre, {150, 1}) < 0.1);
  CHECK(seen->objects[0].length_m == doctest::Approx(4.5));
}

TEST_CASE_FIXTURE(driving_world, "what was seen long ago is not told as if it "
                                 "were still there") {
  run_for(1500ms);
  tell_of_a_car(*this);
  const auto saw = now();
  run_for(10s);
  auto told = 0;
  for (const auto& record : air())
    if (const auto message = message_in<cpm>(record.message))
      if (const auto seen = read_cpm(*message, *in_ulm(), record.at))
        for (std::size_t k = 0; k < seen->objects.size(); ++k, ++told)
          CHECK(seen->at == saw);
  CHECK(told > 0);
  CHECK(told < 3);
}

TEST_CASE_FIXTURE(driving_world, "what a vehicle sends is recorded once, "
                                 "however many hear it") {
  drive(8s); // from none in range of the far one, to one
  run_for(1s);
  const auto sent = air_pdus();
  CHECK(sent.size() > 10);
  const auto heard = near->all<its_pdu>();
  REQUIRE(heard.size() == sent.size());
  for (std::size_t k = 0; k < sent.size(); ++k)
    CHECK(heard[k].octets == sent[k].octets);
}

TEST_CASE("what nobody hears is on the air all the same") {
  driving_world world;
  kill_antennas(world);
  world.run_for(5s);
  CHECK(world.air().size() == 10);
}

TEST_CASE_FIXTURE(driving_world,
                  "driving from one provider to the next changes who hears") {
  drive(45s);
  CHECK(last_report().s_m > 450);
  near->clear();
  distant->clear();
  drive(3s);
  CHECK(near->entries().empty());
  CHECK(messages_in<etsi::cam>(distant->all<its_pdu>()).size() > 5);
}

// -- records -----------------------------------------------------------------

TEST_CASE_FIXTURE(driving_world,
                  "with a new plan every 50 ms no plan is ever old") {
  drive(30s);
  CHECK(total().max_plan_age <= 60ms);
  CHECK(total().without_fresh_plan == 0ms);
  CHECK(total().off_road == 0ms);
  CHECK(total().driven >= 29s);
  CHECK(total().driven <= 30s);
}

TEST_CASE_FIXTURE(driving_world,
                  "time with a plan older than the limit is counted") {
  drive(5s); // the last plan comes at 4.95 s
  run_for(5s);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(total().driven == 10s);
  CHECK(total().max_plan_age == 5050ms);
  CHECK(total().without_fresh_plan == 10s - 4950ms - 200ms);
}

TEST_CASE_FIXTURE(driving_world, "a plan is as old as the cycle that made it") {
  run_for(1s);
  give(plan(), now() - 70ms);
  recorder->clear();
  run_for(100ms);
  REQUIRE(recorder->count<track_record>() == 1);
  const auto track = recorder->all<track_record>().front();
  CHECK(track.plan_age == track.at - (time_point{1s} - 70ms));
}

TEST_CASE_FIXTURE(driving_world, "tracks say which source is in use") {
  const service_name kind{"trajectory_planning"};
  run_for(1s);
  CHECK(!recorder->all<track_record>().back().remote);
  tell(car, source_change{kind, true});
  run_for(1s);
  CHECK(recorder->all<track_record>().back().remote);
  tell(car, source_change{kind, false});
  run_for(1s);
  CHECK(!recorder->all<track_record>().back().remote);
  CHECK(recorder->count<track_record>() == 30);
  CHECK(recorder->all<track_record>().back().ego.own.station == station);
}

TEST_CASE_FIXTURE(driving_world, "a smooth drive is recorded as smooth") {
  drive(30s);
  const auto x = whole_drive();
  CHECK(x.plans.count > 550);
  CHECK(x.plans.emergency == 0);
  CHECK(x.plans.safe_stops == 0);
  CHECK(x.plans.extremes.jerk_mps3 == doctest::Approx(1.5).epsilon(0.01));
  CHECK(x.plans.extremes.lateral_accel_mps2 < 0.01);
  CHECK(x.ride.distance_m
        == doctest::Approx(last_report().s_m - 100)
               .epsilon(0.05)); // the last second is missing
  CHECK(x.ride.extremes.jerk_mps3 < 1.9);
  CHECK(x.ride.extremes.jerk_mps3 > 1);
  CHECK(x.ride.extremes.min_accel_mps2 > -0.1);
  CHECK(x.ride.hard_brakes == 0);
  CHECK(x.ride.comfort_cost_m2ps3 > 5);
  CHECK(recorder->count<plan_switch_record>() == 0);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle that stops on its own says so "
                                 "once, and that it braked hard") {
  drive(10s);
  run_for(30s);
  const auto x = whole_drive();
  CHECK(x.plans.safe_stops == 1);
  CHECK(x.plans.emergency == 0);
  CHECK(x.ride.hard_brakes == 1);
  CHECK(x.ride.extremes.min_accel_mps2 < -3.5);
  CHECK(x.ride.extremes.jerk_mps3 < 1.9); // of the drive before
}

TEST_CASE_FIXTURE(flying_start_world,
                  "a vehicle that starts driving and never gets a plan stops "
                  "on its own, and says so once") {
  run_for(30s);
  CHECK(last_report().state.speed_mps == 0);
  const auto x = whole_drive();
  CHECK(x.plans.count == 0);
  CHECK(x.plans.safe_stops == 1);
  CHECK(x.ride.extremes.jerk_mps3 < 1); // it keeps its speed until then
}

TEST_CASE_FIXTURE(driving_world, "with the first plan from elsewhere the jump "
                                 "to it is recorded") {
  const auto local = source;
  const running_service remote{7, station, "trajectory_planning", 3};
  drive(5s);
  tell(car, source_change{source.kind, true});
  CHECK(recorder->count<plan_switch_record>() == 0); // no plan has come yet

  auto next = plan();
  for (auto& p : next.points) {
    p.at.y_m += 0.3;
    p.speed_mps += 0.5;
    p.accel_mps2 = -1;
    p.curvature_1pm = 0.002;
  }
  source = remote;
  give(next, now());
  give(next, now());
  REQUIRE(recorder->count<plan_switch_record>() == 1);
  const auto to = recorder->all<plan_switch_record>().front();
  CHECK(to.at == now());
  CHECK(to.running == remote);
  CHECK(to.remote);
  CHECK(to.jump.d_m == doctest::Approx(0.3).epsilon(0.05));
  CHECK(to.jump.curvature_1pm == doctest::Approx(0.002));
  CHECK(to.jump.speed_mps == doctest::Approx(0.5).epsilon(0.1));
  CHECK(to.jump.accel_mps2 > 1);

  source = local;
  give(next, now());
  REQUIRE(recorder->count<plan_switch_record>() == 2);
  const auto back = recorder->all<plan_switch_record>().back();
  CHECK(back.running == remote);
  CHECK(!back.remote);
  CHECK(back.jump.d_m == 0);
}

TEST_CASE_FIXTURE(driving_world, "a plan that is not taken is no change of "
                                 "source") {
  drive(5s);
  source.counter = 1;
  give(plan(), now() - 1s);
  give({}, now());
  CHECK(recorder->count<plan_switch_record>() == 0);
}

// -- peers that vanish -------------------------------------------------------

TEST_CASE_FIXTURE(driving_world, "a vehicle outlives its requester: it stops "
                                 "safely") {
  drive(5s);
  kill(requester.handle);
  CHECK(!is_gone(car));
  run_for(20s);
  CHECK(last_report().state.speed_mps == 0);
  CHECK(now() - report_time() < 50ms);
}

TEST_CASE_FIXTURE(driving_world, "a vehicle survives losing everybody else") {
  drive(5s);
  kill(near.handle);
  kill(road.handle);
  kill(recorder.handle);
  run_for(5s);
  CHECK(!is_gone(car));
}

TEST_CASE_FIXTURE(driving_world,
                  "a vehicle that goes takes its requester with it") {
  run_for(500ms);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(is_gone(car));
  CHECK(is_gone(requester.handle));
  CHECK(total().driven == 500ms);
}

TEST_CASE_FIXTURE(driving_world, "at the end of its route a vehicle leaves the "
                                 "streets, and its requester goes with it") {
  drive(120s); // 900 m at 10 m/s
  REQUIRE(road->count<station_id>() == 1);
  CHECK(road->all<station_id>().front() == station);
  CHECK(last_report().s_m > 990);
  CHECK(is_gone(requester.handle));
  std::vector<std::string> events;
  for (const auto& e : recorder->all<event_record>())
    events.push_back(e.what);
  CHECK(events == std::vector<std::string>{"arrived"});
  CHECK(!is_gone(car)); // it waits for the end of the run
}
