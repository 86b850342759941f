// Tests of the service provider: from a CAM to running services.
#include "tests/actors/provider_world.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/random_pdu.hpp"

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct offering_world : provider_world {
  /// A CAM after that time brings an offer, and none a nanosecond before.
  void second_offer_comes_in(duration d) {
    run_for(d - 1ns);
    hear(inside);
    CHECK(offers().size() == 1);
    run_for(1ns);
    hear(inside);
    CHECK(offers().size() == 2);
  }
};

} // namespace

TEST_CASE_FIXTURE(provider_world,
                  "the first CAM is answered by an offer of all services, at "
                  "once, wherever it comes from") {
  hear(outside);
  REQUIRE(offers().size() == 1);
  CHECK(requester->times<service_offer>().front() == now());
  const auto offer = offers().front();
  CHECK(offer.provider == boot);
  CHECK(offer.position == point{1, 2});
  CHECK(offer.services == std::vector{one, two});
}

TEST_CASE_FIXTURE(provider_world, "a station outside is offered to every "
                                  "second, however often it is heard") {
  const auto began = now();
  for (auto k = 0; k < 30; ++k) {
    hear(outside);
    run_for(100ms);
  }
  CHECK(requester->times<service_offer>()
        == std::vector{began, began + 1s, began + 2s});
}

TEST_CASE_FIXTURE(provider_world,
                  "who comes into the area is offered to at once, whenever it "
                  "was before") {
  hear(outside);
  run_for(100ms);
  hear(inside);
  CHECK(offers().size() == 2);
  run_for(100ms);
  hear(inside);
  CHECK(offers().size() == 2);
}

TEST_CASE_FIXTURE(provider_world, "a station is inside as long as its rear "
                                  "axle is, though its front be outside") {
  hear({100.1, 0});
  run_for(100ms);
  hear({100.1, 0});
  CHECK(offers().size() == 1);
  hear({99.9, 0});
  CHECK(offers().size() == 2);
}

TEST_CASE_FIXTURE(provider_world, "offers are repeated every second, exactly") {
  const auto began = now();
  hear(inside);
  stay(3s);
  CHECK(requester->times<service_offer>()
        == std::vector{began, began + 1s, began + 2s, began + 3s});
}

TEST_CASE_FIXTURE(offering_world, "a CAM a nanosecond before the second is "
                                  "over brings no offer") {
  hear(inside);
  second_offer_comes_in(1s);
}

TEST_CASE_FIXTURE(provider_world, "without CAMs there are no offers") {
  hear(inside);
  run_for(1900ms);
  CHECK(offers().size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "only services that do not run are offered again") {
  hear(inside);
  start({two});
  stay(1s);
  REQUIRE(offers().size() == 2);
  CHECK(offers().back().services == std::vector{one});
  start({one});
  stay(3s);
  CHECK(offers().size() == 2);
}

TEST_CASE_FIXTURE(provider_world, "what has ended is offered again") {
  hear(inside);
  start({one, two});
  stay(5s);
  CHECK(offers().size() == 1);
  tell(provider, service_end{verdicts().front().session, end_reason::qos_gap,
                             side::requester});
  stay(1s);
  REQUIRE(offers().size() == 2);
  CHECK(offers().back().services == std::vector{one});
}

TEST_CASE_FIXTURE(offering_world,
                  "what has ended is offered again after a second, exactly") {
  hear(inside);
  start({one, two});
  stay(5s);
  tell(provider, service_end{verdicts().front().session, end_reason::qos_gap,
                             side::requester});
  second_offer_comes_in(1s);
}

TEST_CASE_FIXTURE(provider_world, "a CPM of who has sent no CAM yet brings no "
                                  "offer") {
  see(station);
  run_for(100ms);
  CHECK(requester->entries().empty());
}

TEST_CASE_FIXTURE(provider_world, "what cannot be read is as if it had not "
                                  "come") {
  hear(inside);
  start({one});
  run_for(1s);
  recorder->clear();
  const auto before = offers().size();
  const auto good = pdu_of(cam{station + 1, now(), inside, 0, 10, 0});
  dice d{1};
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(d.between(0, static_cast<double>(n)));
  };
  for (auto k = 0; k < 2000; ++k) {
    its_pdu noise{std::vector<std::byte>(below(300))};
    for (auto& octet : noise.octets)
      octet = static_cast<std::byte>(below(256));
    if (k % 2 == 0 && noise.octets.size() > 2) {
      // An ITS header of no message, with a good one's kind.
      noise.octets[0] = good.octets[0];
      noise.octets[1] = std::byte{99};
    }
    tell(provider, noise, neighbour.handle);
    auto cut = good;
    cut.octets.resize(below(good.octets.size()));
    tell(provider, cut, neighbour.handle);
  }
  tell(provider, its_pdu{}, neighbour.handle);
  CHECK(!is_gone(provider));
  CHECK(neighbour->entries().empty());
  CHECK(offers().size() == before);
  CHECK(recorder->entries().empty());
  CHECK(still_sends());
}

TEST_CASE_FIXTURE(provider_world, "messages with any content do a provider no "
                                  "harm") {
  random_pdu random{1};
  hear(inside);
  start({one});
  for (auto k = 0; k < 500; ++k) {
    tell(provider, encoded(random.message<etsi::cam>()), neighbour.handle);
    tell(provider, encoded(random.message<etsi::tr103562::cpm>()),
         neighbour.handle);
    tell(provider, encoded(random.message<etsi::mcm>()), neighbour.handle);
  }
  CHECK(!is_gone(provider));
  CHECK(still_sends());
}

TEST_CASE_FIXTURE(provider_world, "each station is offered to by itself") {
  hear(inside);
  run_for(500ms);
  hear(inside, neighbour, 102);
  hear(inside);
  CHECK(offers().size() == 1);
  CHECK(neighbour->count<service_offer>() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "who comes back is offered to at the first CAM again") {
  hear(inside);
  run_for(100ms);
  hear(outside);
  CHECK(offers().size() == 1);
  run_for(100ms);
  hear(inside);
  CHECK(offers().size() == 2);
}

// -- request and response ----------------------------------------------------

TEST_CASE_FIXTURE(provider_world, "the CODM judges a request as it came") {
  hear(inside);
  auto request = make_request({two, one});
  request.route = {{10, 0}, {20, 0}, {30, 5}};
  request.speed_mps = 12.5;
  ask(request);
  REQUIRE(codm->asked.size() == 1);
  const auto& asked = codm->asked.front();
  CHECK(asked.now == now());
  CHECK(asked.station == station);
  CHECK(asked.services == std::vector<std::string>{"two", "one"});
  CHECK(asked.route == request.route);
  CHECK(asked.speed_mps == 12.5);
  CHECK(asked.sessions.empty());
}

TEST_CASE_FIXTURE(provider_world, "the CODM sees what runs, of all stations") {
  hear(inside);
  hear(inside, neighbour, 102);
  start({one, two});
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  REQUIRE(codm->asked.size() == 2);
  using sessions = std::vector<std::pair<station_id, std::string>>;
  CHECK(codm->asked.back().sessions
        == sessions{{station, "one"}, {station, "two"}});
}

TEST_CASE_FIXTURE(provider_world, "offers and the CODM tell what share of the "
                                  "workers is needed by what runs") {
  // Every 50 ms 10 ms on one of two workers.
  compute.alone = delay_distribution::uniform(5ms, 15ms);
  compute.workers = 2;
  restart();
  hear(inside);
  CHECK(offers().back().utilisation == 0);
  start({one});
  CHECK(codm->used.back().first == 0);
  CHECK(codm->used.back().second == doctest::Approx(0.1));
  hear(inside, neighbour, 102);
  CHECK(neighbour->all<service_offer>().back().utilisation
        == doctest::Approx(0.1));
  start({two});
  CHECK(codm->used.back().first == doctest::Approx(0.1));
}

TEST_CASE_FIXTURE(provider_world, "a service computes at the offset that the "
                                  "CODM has assigned, and stays there") {
  codm->worker = 1;
  codm->offset = 30ms;
  compute.workers = 2;
  restart();
  hear(inside);
  start({one});
  run_for(200ms);
  const auto results = requester->all<service_result>();
  REQUIRE(results.size() >= 3);
  for (const auto& result : results)
    CHECK(result.created.time_since_epoch() % 50ms == 30ms);
  codm->offset.reset();
  start({two});
  REQUIRE(codm->sessions.size() == 1);
  CHECK(codm->sessions.front().worker == 1);
  CHECK(codm->sessions.front().task.offset == 30ms);
  CHECK(codm->sessions.front().task.period == 50ms);
}

TEST_CASE_FIXTURE(provider_world, "a request is answered at once, a verdict "
                                  "for each service, in their order") {
  codm->accepted = {"two"};
  hear(inside);
  ask(make_request({one, two}));
  REQUIRE(responses().size() == 1);
  CHECK(requester->times<service_response>().front() == now());
  const auto r = responses().front();
  CHECK(r.provider == boot);
  CHECK(r.station == station);
  CHECK(r.number == last_number);
  REQUIRE(r.verdicts.size() == 2);
  CHECK(r.verdicts[0].session == session_id{boot, station, one, 0});
  CHECK(!r.verdicts[0].accepted);
  CHECK(r.verdicts[0].why == "as told");
  CHECK(r.verdicts[1].accepted);
  CHECK(r.verdicts[1].session.service == two);
  CHECK(r.verdicts[1].session.counter > 0);
  CHECK(managers().size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "an accepted service runs from its first input on") {
  hear(inside);
  ask(make_request({one}));
  CHECK(!still_sends());
  hear(inside);
  tell(managers().front(), service_input{{}, now(), payload::of(echo{5})});
  run_for(10ms);
  REQUIRE(requester->count<service_result>() > 0);
  const auto result = requester->all<service_result>().front();
  CHECK(result.session == verdicts().front().session);
  CHECK(result.what.as<echo>()->number == 5);
}

TEST_CASE_FIXTURE(provider_world, "an unknown service is refused, whatever the "
                                  "CODM says; the others are not") {
  codm->accepted = {"one", "unheard_of"};
  hear(inside);
  ask(make_request({"unheard_of", one}));
  REQUIRE(verdicts().size() == 2);
  CHECK(!verdicts()[0].accepted);
  CHECK(!verdicts()[0].session.is_remote());
  CHECK(verdicts()[1].accepted);
  CHECK(managers().size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "counters rise over services, stations and episodes") {
  hear(inside);
  hear(inside, neighbour, 102);
  ask(make_request({one, two}));
  const auto first = verdicts();
  tell(provider, service_request{boot, 102, 1, {one}, {inside}, 10},
       neighbour.handle);
  const auto second =
      neighbour->all<service_response>().front().verdicts.front();
  hear(outside);
  hear(inside);
  ask(make_request({one}));
  const auto third = verdicts().front();
  CHECK(first[0].session.counter == 1);
  CHECK(first[1].session.counter == 2);
  CHECK(second.session.counter == 3);
  CHECK(third.session.counter == 4);
}

TEST_CASE_FIXTURE(provider_world, "the duplicate of a request is ignored") {
  hear(inside);
  const auto request = make_request({one});
  ask(request);
  run_for(50ms);
  ask(request);
  CHECK(responses().size() == 1);
  CHECK(ends().empty());
  CHECK(codm->asked.size() == 1);
}

TEST_CASE_FIXTURE(provider_world,
                  "a request that was overtaken by a newer one is ignored") {
  hear(inside);
  const auto older = make_request({one});
  ask(make_request({two}));
  ask(older);
  REQUIRE(responses().size() == 1);
  CHECK(verdicts().front().session.service == two);
}

TEST_CASE_FIXTURE(provider_world, "a station nobody has seen is refused") {
  ask(make_request({one, two}));
  REQUIRE(responses().size() == 1);
  CHECK(responses().front().number == last_number);
  REQUIRE(verdicts().size() == 2);
  for (const auto& v : verdicts()) {
    CHECK(!v.accepted);
    CHECK(!v.session.is_remote());
  }
  CHECK(managers().empty());
  CHECK(codm->asked.empty());
}

TEST_CASE_FIXTURE(provider_world, "whether a station outside is accepted is "
                                  "left to the CODM") {
  codm->accepted = {"one"};
  hear(inside);
  hear(outside);
  ask(make_request({one, two}));
  CHECK(codm->asked.size() == 1);
  REQUIRE(verdicts().size() == 2);
  CHECK(verdicts()[0].accepted);
  CHECK(!verdicts()[1].accepted);
}

TEST_CASE_FIXTURE(provider_world,
                  "a request to an earlier life of the provider is refused") {
  hear(inside);
  auto request = make_request({one});
  request.provider = boot - 1;
  ask(request);
  REQUIRE(responses().size() == 1);
  CHECK(!verdicts().front().accepted);
  CHECK(codm->asked.empty());
}

TEST_CASE_FIXTURE(provider_world, "who asks for what runs has missed its end: "
                                  "it is closed and started anew") {
  hear(inside);
  start({one});
  const auto before = verdicts().front().session;
  const auto manager = managers().front();
  run_for(1s);
  ask(make_request({one}));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().session == before);
  CHECK(is_gone(manager));
  CHECK(verdicts().front().accepted);
  CHECK(verdicts().front().session.counter > before.counter);
}

TEST_CASE_FIXTURE(provider_world, "a request for nothing is answered so") {
  hear(inside);
  ask(make_request({}));
  REQUIRE(responses().size() == 1);
  CHECK(verdicts().empty());
}

TEST_CASE_FIXTURE(provider_world, "the CODM is asked about offered services "
                                  "alone, once each") {
  hear(inside);
  ask(make_request({"unheard_of", one, one, two, "unheard_of"}));
  REQUIRE(codm->asked.size() == 1);
  CHECK(codm->asked.front().services == std::vector<std::string>{"one", "two"});
  std::vector<std::string> why;
  for (const auto& v : verdicts())
    why.push_back(v.why);
  CHECK(why
        == std::vector<std::string>{"not offered here", "as told",
                                    "named twice", "as told",
                                    "not offered here"});
  CHECK(managers().size() == 2);
}

TEST_CASE_FIXTURE(provider_world,
                  "a request that names a service twice starts it once") {
  hear(inside);
  ask(make_request({one, one}));
  CHECK(managers().size() == 1);
  hear(outside);
  CHECK(episodes().size() == 1);
}
