// Tests of the vehicle: what it says to everybody, and what it takes from
// those that plan for it.
#include "tests/actors/driving_world.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/each_number.hpp"

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

// -- up ----------------------------------------------------------------------

TEST_CASE_FIXTURE(driving_world,
                  "only providers in range hear a CAM, and whom to answer") {
  run_for(10s);
  CHECK(messages_in<etsi::cam>(near->all<its_pdu>()).size() == 10);
  CHECK(distant->entries().empty());
  CHECK(connected == std::vector<std::size_t>{0});
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

TEST_CASE("what a vehicle sends is recorded once, however many hear it") {
  for (const double range_m : {0, 100, 1000}) {
    CAPTURE(range_m);
    driving_world world{0, v2x_options{}, range_m};
    world.drive(5s);
    const auto sent = world.air_pdus();
    CHECK(sent.size() > 10);
    const auto check_heard = [&](const probe<link_actor>& who) {
      const auto heard = who->all<its_pdu>();
      REQUIRE(heard.size() == sent.size());
      for (std::size_t k = 0; k < sent.size(); ++k)
        CHECK(heard[k].octets == sent[k].octets);
    };
    if (range_m > 0)
      check_heard(world.near);
    if (range_m > 100)
      check_heard(world.distant);
    else
      CHECK(world.distant->entries().empty());
  }
}

TEST_CASE_FIXTURE(driving_world,
                  "driving from one provider to the next changes who hears") {
  drive(45s);
  CHECK(last_report().s_m > 450);
  CHECK(connected == std::vector<std::size_t>{0, 1}); // each as it was reached
  near->clear();
  distant->clear();
  drive(3s);
  CHECK(near->entries().empty());
  CHECK(messages_in<etsi::cam>(distant->all<its_pdu>()).size() > 5);
}

// -- down --------------------------------------------------------------------

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
