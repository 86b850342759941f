// Tests of the service provider: requests that are decided together, decisions
// that are missing, and services that are revoked.
#include "policies/filtered.hpp"
#include "tests/actors/provider_world.hpp"

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::channel;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace sofof::world;

namespace {

struct patient_world : provider_world {
  patient_world() { begin_anew(0.25); }

  /// A provider whose policy has this epoch.
  void begin_anew(double epoch_s) {
    codm->epoch_s = epoch_s;
    provider = own(spawn_service_provider(system(), setup()));
    hear(inside);
    hear(inside, neighbour, 102);
  }
  void ask_as_neighbour(std::uint32_t number, std::vector<service_name> kinds) {
    tell(provider,
         service_request{boot, 102, number, std::move(kinds), {inside}, 10},
         neighbour.handle);
  }
};

std::vector<bool> accepted(const std::vector<verdict>& verdicts) {
  std::vector<bool> all;
  for (const auto& v : verdicts) {
    all.push_back(v.accepted);
    CHECK(v.accepted == v.session.is_remote());
  }
  return all;
}

using yes_or_no = std::vector<bool>;

} // namespace

TEST_CASE_FIXTURE(patient_world, "requests of an epoch are decided together, "
                                 "and answered at its end") {
  ask(make_request({one}));
  run_for(100ms);
  ask_as_neighbour(1, {two, one});
  run_for(150ms - 1ns);
  CHECK(codm->asked.empty());
  CHECK(responses().empty());
  run_for(1ns);
  REQUIRE(codm->asked.size() == 1);
  CHECK(codm->asked.front().services
        == std::vector<std::string>{"one", "two", "one"});
  REQUIRE(responses().size() == 1);
  CHECK(requester->times<service_response>().front() == now());
  CHECK(accepted(verdicts()) == yes_or_no{true});
  REQUIRE(neighbour->count<service_response>() == 1);
  CHECK(accepted(neighbour->all<service_response>().front().verdicts)
        == yes_or_no{true, true});
  run_for(1s);
  CHECK(codm->asked.size() == 1); // nobody asked any more
}

TEST_CASE_FIXTURE(patient_world, "the next request begins an epoch of its "
                                 "own") {
  ask(make_request({one}));
  run_for(300ms);
  ask(make_request({two}));
  run_for(250ms - 1ns);
  CHECK(responses().size() == 1);
  run_for(1ns);
  CHECK(responses().size() == 2);
}

TEST_CASE_FIXTURE(patient_world, "who asks twice within an epoch has given up "
                                 "the first request") {
  ask(make_request({one}));
  run_for(100ms);
  ask(make_request({one, two}));
  run_for(150ms);
  REQUIRE(responses().size() == 1);
  CHECK(responses().front().number == last_number);
  CHECK(codm->asked.front().services == std::vector<std::string>{"one", "two"});
  CHECK(managers().size() == 2);
  CHECK(accepted(verdicts()) == yes_or_no{true, true});
  run_for(250ms);
  CHECK(codm->asked.size() == 1);
  hear(outside);
  CHECK(episodes().size() == 2);
}

TEST_CASE_FIXTURE(patient_world, "who has left before the epoch is over keeps "
                                 "nothing beyond its next CAM") {
  ask(make_request({one}));
  ask_as_neighbour(1, {one});
  run_for(100ms);
  hear(outside);
  run_for(150ms);
  CHECK(accepted(verdicts()) == yes_or_no{true}); // it asked from inside
  CHECK(accepted(neighbour->all<service_response>().front().verdicts)
        == yes_or_no{true});
  hear(outside);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == verdicts().front().session);
  CHECK(ends().front().reason == end_reason::left_area);
}

TEST_CASE_FIXTURE(patient_world, "a station that has begun anew is not "
                                 "answered for the one before") {
  ask(make_request({one}));
  run_for(100ms);
  const auto reborn = listen<requester_actor>();
  hear(inside, reborn);
  run_for(150ms);
  CHECK(responses().empty());
  CHECK(codm->asked.empty());
  tell(provider, service_request{boot, station, 1, {one}, {inside}, 10},
       reborn.handle);
  run_for(250ms);
  CHECK(reborn->count<service_response>() == 1);
}

TEST_CASE_FIXTURE(patient_world, "a new requester may have asked before it is "
                                 "heard") {
  const auto reborn = listen<requester_actor>();
  const service_request asked{boot, station, 1, {one}, {inside}, 10};
  tell(provider, asked, reborn.handle);
  run_for(100ms);
  hear(inside, reborn);
  tell(provider, asked, reborn.handle);
  run_for(250ms);
  CHECK(reborn->count<service_response>() == 1);
}

TEST_CASE_FIXTURE(patient_world, "what the CODM leaves undecided is refused") {
  codm->at_most = 2;
  ask(make_request({one, two}));
  ask_as_neighbour(1, {one, two});
  run_for(250ms);
  CHECK(accepted(verdicts()) == yes_or_no{true, true});
  const auto others = neighbour->all<service_response>().front().verdicts;
  CHECK(accepted(others) == yes_or_no{false, false});
  CHECK(others.front().why == "not decided");
  codm->at_most = 0;
  ask_as_neighbour(2, {one});
  run_for(250ms);
  CHECK(accepted(neighbour->all<service_response>().back().verdicts)
        == yes_or_no{false});
  CHECK(!is_gone(provider));
}

TEST_CASE_FIXTURE(provider_world, "what a choice behind a filter leaves "
                                  "undecided is refused") {
  auto s = setup();
  s.codm = std::make_unique<filtered_codm>(std::make_unique<spy_codm>(codm));
  s.map = std::make_shared<const road_map>(
      road_map{"street",
               {},
               {{"street", {{-500, 0}, {500, 0}}, 1.75, {{0, 14}}, {}, 0}}});
  provider = own(spawn_service_provider(system(), std::move(s)));
  hear(inside);
  codm->at_most = 1;
  const auto ask_on_the_road = [this](std::vector<service_name> kinds) {
    auto request = make_request(std::move(kinds));
    request.route = {inside, {90, 0}};
    ask(request);
  };
  ask_on_the_road({one, two});
  REQUIRE(codm->asked.size() == 1);
  CHECK(codm->asked.front().services.size() == 2);
  CHECK(accepted(verdicts()) == yes_or_no{true, false});
  CHECK(verdicts().back().why == "not decided");
  codm->at_most = 0;
  ask_on_the_road({two});
  CHECK(accepted(verdicts()) == yes_or_no{false});
  CHECK(!is_gone(provider));
}

TEST_CASE_FIXTURE(provider_world, "a service that the CODM revokes ends, and "
                                  "its vehicle is told why") {
  hear(inside);
  hear(inside, neighbour, 102);
  start({one, two});
  CHECK(still_sends());
  const auto before = verdicts();
  const auto of_one = managers().front();
  const auto of_two = managers().back();
  codm->revoked = {"one"};
  tell(provider, service_request{boot, 102, 1, {two}, {inside}, 10},
       neighbour.handle);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == before.front().session);
  CHECK(ends().front().reason == end_reason::revoked);
  CHECK(ends().front().from == side::provider);
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().session == before.front().session);
  CHECK(episodes().front().reason == end_reason::revoked);
  CHECK(is_gone(of_one));
  CHECK(!is_gone(of_two));
  CHECK(neighbour->all<service_response>().front().verdicts.front().accepted);
  codm->revoked = {};
  stay(1s);
  CHECK(offers().back().services == std::vector{one});
}

TEST_CASE_FIXTURE(provider_world, "sessions that the CODM does not mention go "
                                  "on") {
  hear(inside);
  start({one, two});
  hear(inside, neighbour, 102);
  codm->revoked = {"one", "two"};
  codm->at_most = 1; // about the request alone
  tell(provider, service_request{boot, 102, 1, {two}, {inside}, 10},
       neighbour.handle);
  CHECK(ends().empty());
  CHECK(episodes().empty());
  CHECK(still_sends());
}

TEST_CASE_FIXTURE(provider_world, "a refusal names who should be asked "
                                  "instead, an acceptance nobody") {
  codm->accepted = {"one"};
  codm->instead = 22;
  hear(inside);
  ask(make_request({one, two, "unheard_of"}));
  REQUIRE(verdicts().size() == 3);
  CHECK(!verdicts()[0].instead);
  CHECK(verdicts()[1].instead == 22);
  CHECK(!verdicts()[2].instead);
}

TEST_CASE_FIXTURE(provider_world, "offers tell workers, the mean computing "
                                  "time and when they were made") {
  compute.alone = delay_distribution::uniform(5ms, 15ms);
  compute.workers = 3;
  restart();
  hear(inside);
  stay(1s);
  REQUIRE(offers().size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(offers()[k].workers == 3);
    CHECK(offers()[k].computing == 10ms);
    CHECK(offers()[k].created == requester->times<service_offer>()[k]);
  }
}

TEST_CASE_FIXTURE(provider_world, "the CODM sees whom a vehicle could ask, "
                                  "while it asks and as long as it is "
                                  "served") {
  hear(inside);
  auto request = make_request({one});
  request.candidates = {{boot, 0.25, 0.5}, {22, -0.5, 0.125}};
  ask(request);
  CHECK(codm->candidates == request.candidates);
  ask(make_request({two}));
  CHECK(codm->candidates.empty());
  REQUIRE(codm->sessions.size() == 1);
  CHECK(codm->served == request.candidates);
}

TEST_CASE_FIXTURE(patient_world, "a station that has fallen silent is not "
                                 "answered when it is heard again") {
  begin_anew(3);
  ask(make_request({one}));
  run_for(2s + 1ms); // it is forgotten
  hear(inside);
  run_for(1s);
  CHECK(responses().empty());
  CHECK(codm->asked.empty());
  ask(make_request({one}));
  stay(3s);
  CHECK(responses().size() == 1);
}

TEST_CASE_FIXTURE(provider_world, "who asks by the name that the provider had "
                                  "before it started again is refused in that "
                                  "name") {
  hear(inside);
  auto request = make_request({one, two});
  request.provider = boot - 1;
  ask(request);
  REQUIRE(responses().size() == 1);
  CHECK(responses().front().provider == boot - 1);
  CHECK(responses().front().number == request.number);
  REQUIRE(verdicts().size() == 2);
  for (const auto& v : verdicts()) {
    CHECK(!v.accepted);
    CHECK(v.session.provider == boot - 1);
    CHECK(v.why == "not heard here");
  }
}

namespace {

/// "two" is made of the results of "one".
struct chained_world : provider_world {
  chained_world() {
    auto made = setup();
    made.services[1].follows = one;
    provider = own(spawn_service_provider(system(), std::move(made)));
    hear(inside);
    hear(inside, neighbour, 102);
  }
  static bool is(const linked_service& link, std::string_view service,
                 link_place at) {
    return link.service == service && link.at == at;
  }
};

} // namespace

TEST_CASE_FIXTURE(chained_world, "a CODM is told which service a request "
                                 "follows, and whether it is here") {
  ask(make_request({two}));
  REQUIRE(codm->links.size() == 1);
  CHECK(is(codm->links[0].follows, "one", link_place::elsewhere));
  CHECK(is(codm->links[0].followed_by, "", link_place::none));
  ask(make_request({one, two}));
  REQUIRE(codm->links.size() == 2);
  CHECK(is(codm->links[0].follows, "", link_place::none));
  CHECK(is(codm->links[0].followed_by, "two", link_place::asked));
  CHECK(is(codm->links[1].follows, "one", link_place::asked));
  ask(make_request({two})); // "one" goes on
  REQUIRE(codm->links.size() == 1);
  CHECK(is(codm->links[0].follows, "one", link_place::here));
  REQUIRE(codm->sessions.size() == 1);
  CHECK(is(codm->sessions[0].links.followed_by, "two", link_place::asked));
}

TEST_CASE_FIXTURE(chained_world, "what runs for one vehicle is not here for "
                                 "another one") {
  ask(make_request({one}));
  tell(provider, service_request{boot, 102, 1, {two}, {inside}, 10},
       neighbour.handle);
  REQUIRE(codm->links.size() == 1);
  CHECK(is(codm->links[0].follows, "one", link_place::elsewhere));
  REQUIRE(codm->sessions.size() == 1);
  CHECK(is(codm->sessions[0].links.followed_by, "two", link_place::elsewhere));
}
