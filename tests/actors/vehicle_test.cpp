// Tests of the vehicle: it drives, is seen, and never is without a plan.
#include "tests/actors/driving_world.hpp"

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;
using namespace sofof::world;

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

TEST_CASE_FIXTURE(flying_start_world,
                  "the time that a part of a vehicle is "
                  "beyond the edge of its road is counted") {
  drive(2s);
  CHECK(total().off_road == 0ms);
  auto away = plan();
  for (auto& p : away.points)
    p.at.y_m += 2;
  give(away, now());
  run_for(4s);
  const vehicle_params size;
  constexpr double edge_m = 1.75;
  duration beyond{};
  for (const auto& r : road->all<motion_report>()) {
    const auto rear_m = r.state.at.y_m;
    const auto front_m =
        rear_m + size.wheelbase_m * std::sin(r.state.heading_rad);
    if (std::max(rear_m, front_m) + size.width_m / 2 > edge_m)
      beyond += 50ms;
  }
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(beyond > 1s);
  CHECK(total().off_road == beyond);
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

TEST_CASE_FIXTURE(flying_start_world,
                  "whenever it perceives, a vehicle tells where it is then") {
  tell(car, manager.handle);
  for (const auto pause : {10ms, 37ms, 3ms, 110ms, 1ms}) {
    run_for(pause);
    tell_of_a_car(*this);
    const auto input = manager->all<service_input>().back();
    const auto own = input.what.as<plan_request>()->own;
    const auto passed_s = to_seconds(own.at - time_point{});
    CHECK(now() - own.at < 10ms);
    CHECK(own.position.x_m
          == doctest::Approx(100 + 10 * passed_s).epsilon(1e-4));
  }
}

TEST_CASE("where a vehicle drives does not hang on how often it is asked") {
  flying_start_world seldom, often;
  for (auto* world : {&seldom, &often})
    world->tell(world->car, world->manager.handle);
  for (const auto pause : {13ms, 50ms, 7ms, 131ms, 20ms, 64ms, 1ms}) {
    for (auto* world : {&seldom, &often}) {
      auto slower = world->plan();
      for (auto& p : slower.points) {
        p.speed_mps *= 0.8;
        p.accel_mps2 = -1;
      }
      world->give(slower, world->now());
    }
    seldom.run_for(pause);
    for (auto left = pause; left > 0ms; left -= 1ms) {
      often.run_for(1ms);
      tell_of_a_car(often);
    }
    const auto one = seldom.last_report(), other = often.last_report();
    CHECK(seldom.report_time() == often.report_time());
    CHECK(one.s_m == other.s_m);
    CHECK(one.state.speed_mps == other.state.speed_mps);
    CHECK(one.state.steer_rad == other.state.steer_rad);
  }
  CHECK(seldom.last_report().state.speed_mps < 9.9);
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

TEST_CASE("a vehicle that nobody plans for any more begins to brake after a "
          "second") {
  driving_world world{0, v2x_options{}, 100, {}, 1s};
  world.drive(10s);
  world.run_for(900ms);
  const auto before_mps = world.last_report().state.speed_mps;
  world.run_for(1s);
  CHECK(world.last_report().state.speed_mps < before_mps - 2);
  world.run_for(3s);
  CHECK(world.last_report().state.speed_mps == 0);
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
  const session_id remote{7, station, "trajectory_planning", 3};
  drive(5s);
  tell(car, source_change{source.service, true});
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
  CHECK(to.session == remote);
  CHECK(to.remote);
  CHECK(to.jump.d_m == doctest::Approx(0.3).epsilon(0.05));
  CHECK(to.jump.curvature_1pm == doctest::Approx(0.002));
  CHECK(to.jump.speed_mps == doctest::Approx(0.5).epsilon(0.1));
  CHECK(to.jump.accel_mps2 > 1);

  source = local;
  give(next, now());
  REQUIRE(recorder->count<plan_switch_record>() == 2);
  const auto back = recorder->all<plan_switch_record>().back();
  CHECK(back.session == remote);
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
  REQUIRE(road->count<station_id::rep>() == 1);
  CHECK(road->all<station_id::rep>().front() == station);
  CHECK(last_report().s_m > 980);
  CHECK(is_gone(requester.handle));
  std::vector<event_type> events;
  for (const auto& e : recorder->all<event_record>())
    events.push_back(e.what);
  CHECK(events == std::vector{event_type::arrived});
  CHECK(!is_gone(car)); // it waits for the end of the run
}

TEST_CASE_FIXTURE(driving_world, "a trip is recorded once, when the vehicle "
                                 "arrives") {
  drive(120s);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  REQUIRE(recorder->count<trip_record>() == 1);
  const auto [who, trip] = recorder->all<trip_record>().front();
  CHECK(who == station);
  CHECK(trip.has_arrived);
  CHECK(trip.driven_s == doctest::Approx(to_seconds(total().driven)));
  CHECK(std::abs(trip.delay_s()) < 3);
  CHECK(trip.stops == 0); // the end is none
}

TEST_CASE_FIXTURE(driving_world, "a trip that the end of the run cuts off is "
                                 "recorded as far as it came") {
  drive(20s);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  REQUIRE(recorder->count<trip_record>() == 1);
  const auto trip = recorder->all<trip_record>().front().trip;
  CHECK(!trip.has_arrived);
  CHECK(trip.driven_s == doctest::Approx(20).epsilon(0.01));
  CHECK(trip.stops == 0);
}

TEST_CASE_FIXTURE(late_world, "before its time a vehicle is nowhere; then it "
                              "asks for its place") {
  run_for(9s);
  CHECK(road->entries().empty());
  CHECK(near->entries().empty());
  run_for(5s);
  REQUIRE(road->count<begin_atom>() == 1);
  CHECK(road->times<begin_atom>().front() == time_point{10s});
  CHECK(road->seconds<motion_report>().front().s_m == 100);
  CHECK(road->count<motion_report>() == 0);
  CHECK(total().driven == 0ms);
}

TEST_CASE_FIXTURE(late_world, "a vehicle that was let in drives like any") {
  run_for(12s);
  tell(car, begin_atom_v);
  CHECK(last_report().state.speed_mps == 0);
  run_for(1s);
  drive(5s);
  CHECK(last_report().state.speed_mps > 3);
  CHECK(total().driven >= 5s);
  CHECK(total().driven <= 6s);
  const auto events = recorder->all<event_record>();
  REQUIRE(!events.empty());
  CHECK(events.front().what == event_type::appeared);
  CHECK(events.front().at == time_point{12s});
}

TEST_CASE_FIXTURE(late_world, "who never appears leaves without a word") {
  run_for(12s);
  caf::anon_send_exit(car, caf::exit_reason::user_shutdown);
  settle();
  CHECK(recorder->entries().empty());
}
