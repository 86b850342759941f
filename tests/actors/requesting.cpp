// Tests of the service requester: from an offer to the first data.
#include "base/protocol.hpp"
#include "tests/actors/requester_world.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(requester_world, "a wanted offer is answered by one request "
                                   "for all its services, at once") {
  offer({one, two});
  REQUIRE(requests() == 1);
  CHECK(provider->times<service_request>().front() == now());
  const auto request = last_request();
  CHECK(request.provider == here);
  CHECK(request.station == station);
  CHECK(request.services == std::vector{one, two});
  CHECK(provider->seconds<requester_actor>().front()
        == requester_actor{requester});
}

TEST_CASE_FIXTURE(requester_world,
                  "a request carries the planned route and the speed") {
  drive_to(250, 12);
  offer({one});
  const auto request = last_request();
  CHECK(request.speed_mps == 12);
  REQUIRE(request.route.size() > 2);
  CHECK(distance_m(request.route.front(), {250, 0}) < 0.1);
  CHECK(distance_m(request.route.back(), {1050, 0}) < 0.1);
}

TEST_CASE_FIXTURE(requester_world,
                  "the LODM is asked about every offered service it knows") {
  drive_to(250, 12);
  offer({one, "unheard_of", two});
  REQUIRE(lodm->asked.size() == 2);
  CHECK(lodm->asked[0].service == "one");
  CHECK(lodm->asked[1].service == "two");
  CHECK(lodm->asked[0].now == now());
  CHECK(lodm->asked[0].provider_at == point{500, 20});
  CHECK(lodm->asked[0].speed_mps == 12);
  REQUIRE(!lodm->asked[0].path.empty());
  CHECK(distance_m(lodm->asked[0].path.front(), {250, 0}) < 0.1);
  CHECK(last_request().services == std::vector{one, two});
}

TEST_CASE_FIXTURE(requester_world, "what the LODM does not want stays local") {
  lodm->wanted = {"two"};
  offer({one, two});
  CHECK(last_request().services == std::vector{two});
  lodm->wanted = {};
  run_for(2s);
  offer({one, two});
  CHECK(requests() == 1);
}

TEST_CASE_FIXTURE(requester_world, "an offer of nothing is not answered") {
  offer({});
  offer({"unheard_of"});
  CHECK(requests() == 0);
}

TEST_CASE_FIXTURE(requester_world, "an offer from nobody is not answered") {
  tell(requester, service_offer{here, {}, {one, two}});
  CHECK(requests() == 0);
  CHECK(!is_gone(requester));
}

TEST_CASE_FIXTURE(requester_world, "there is one open request per provider") {
  lodm->wanted = {"one"};
  offer({one, two});
  lodm->wanted = {"one", "two"};
  offer({one, two});
  run_for(400ms);
  offer({two});
  CHECK(requests() == 1);
  answer(last_request(), {{one, 0}});
  offer({two});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world,
                  "what was asked of one provider is not asked of another") {
  lodm->wanted = {"one"};
  offer({one, two});
  lodm->wanted = {"one", "two"};
  offer_from(other, elsewhere, {one, two});
  REQUIRE(other->count<service_request>() == 1);
  CHECK(other->all<service_request>().front().services == std::vector{two});
  CHECK(other->all<service_request>().front().provider == elsewhere);
}

TEST_CASE_FIXTURE(requester_world, "the LODM sees all who offer a service, the "
                                   "one that offers it just now first") {
  lodm->wanted = {};
  offer({one});
  offer_from(other, elsewhere, {one, two});
  const auto ids = [](const auto& question) {
    std::vector<provider_id> all;
    for (const auto& provider : question.providers)
      all.push_back(provider.id);
    return all;
  };
  REQUIRE(lodm->asked.size() == 3);
  CHECK(ids(lodm->asked[0]) == std::vector<provider_id>{here});
  CHECK(ids(lodm->asked[1]) == std::vector<provider_id>{elsewhere, here});
  CHECK(ids(lodm->asked[2]) == std::vector<provider_id>{elsewhere});
}

TEST_CASE_FIXTURE(requester_world,
                  "the LODM is told how busy a provider says it is") {
  lodm->wanted = {};
  tell_as(provider.handle, requester, service_offer{here, {}, {one}, 0.75});
  REQUIRE(lodm->asked.size() == 1);
  CHECK(lodm->asked[0].providers.front().utilisation == 0.75);
}

TEST_CASE_FIXTURE(requester_world, "who offered before may be chosen") {
  lodm->wanted = {};
  offer({one});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  offer_from(other, elsewhere, {one});
  CHECK(requests() == 1);
  CHECK(other->count<service_request>() == 0);
}

TEST_CASE_FIXTURE(requester_world, "an old offer is none, and neither is one "
                                   "that was taken up") {
  lodm->wanted = {};
  lodm->preferred = here;
  offer({one, two});
  run_for(protocol::offer_validity + 1ms);
  lodm->wanted = {"one", "two"};
  offer_from(other, elsewhere, {one});
  CHECK(requests() == 0);
  offer({one});
  REQUIRE(requests() == 1);
  answer(last_request(), {{one, 0}});
  offer_from(other, elsewhere, {one});
  CHECK(requests() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "a service that an offer names often is asked "
                  "for once") {
  offer({one, one, two, one});
  REQUIRE(requests() == 1);
  CHECK(last_request().services == std::vector{one, two});
}

TEST_CASE_FIXTURE(requester_world, "nobody speaks for another provider") {
  lodm->wanted = {};
  offer({one});
  lodm->wanted = {"one"};
  offer_from(other, here, {one});
  CHECK(requests() == 0);
  CHECK(other->count<service_request>() == 0);
  CHECK(lodm->asked.size() == 1);
}

TEST_CASE_FIXTURE(requester_world, "who claims to be less than idle counts as "
                                   "idle") {
  tell_as(provider.handle, requester, service_offer{here, {}, {one}, -7});
  REQUIRE(lodm->asked.size() == 1);
  CHECK(lodm->asked[0].providers.front().utilisation == 0);
}

TEST_CASE_FIXTURE(requester_world, "nobody is asked whom the LODM invents") {
  lodm->preferred = 99;
  offer({one});
  CHECK(requests() == 0);
  CHECK(!is_gone(requester));
}

TEST_CASE_FIXTURE(requester_world, "request numbers rise, whoever is asked") {
  lodm->wanted = {"one"};
  offer({one});
  lodm->wanted = {"two"};
  offer_from(other, elsewhere, {two});
  run_for(1s);
  offer({two});
  const auto second = other->all<service_request>().front();
  const auto all = provider->all<service_request>();
  REQUIRE(all.size() == 2);
  CHECK(all[0].number > 0);
  CHECK(second.number > all[0].number);
  CHECK(all[1].number > second.number);
}

// -- the response ------------------------------------------------------------

TEST_CASE_FIXTURE(requester_world,
                  "a refused service stays local and can be asked for again") {
  offer({one});
  answer(last_request(), {{one, 0}});
  REQUIRE(decisions().size() == 1);
  CHECK(!decisions().front().accepted);
  CHECK(decisions().front().station == station);
  CHECK(decisions().front().service == one);
  CHECK(episodes().empty());
  CHECK(ends().empty());
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world, "an accepted service is fed at once, and "
                                   "the local one runs on") {
  start({one});
  REQUIRE(decisions().size() == 1);
  CHECK(decisions().front().accepted);
  REQUIRE(manager->count<service_input>() == 1);
  CHECK(manager->all<service_input>().front().session == at_here(one, 7));
  CHECK(!is_remote(one));
  run_for(500ms);
  CHECK(local_results().size() == 20); // both kinds, 20 Hz
}

TEST_CASE_FIXTURE(requester_world, "what runs is not asked for again") {
  start({one});
  offer({one});
  CHECK(requests() == 1);
  result(at_here(one, 7), 1);
  offer({one});
  offer_from(other, elsewhere, {one});
  CHECK(requests() == 1);
  CHECK(other->count<service_request>() == 0);
}

TEST_CASE_FIXTURE(requester_world, "services asked for together are accepted "
                                   "and refused one by one") {
  offer({one, two});
  answer(last_request(), {{one, 0}, {two, 7}});
  const auto d = decisions();
  REQUIRE(d.size() == 2);
  CHECK(d[0].service == one);
  CHECK(!d[0].accepted);
  CHECK(d[1].service == two);
  CHECK(d[1].accepted);
  result(at_here(two, 7), 1);
  CHECK(is_remote(two));
  CHECK(!is_remote(one));
  REQUIRE(manager->count<service_input>() == 1);
  CHECK(manager->all<service_input>().front().session == at_here(two, 7));
}

TEST_CASE_FIXTURE(requester_world,
                  "a service that a response leaves out counts as refused") {
  offer({one, two});
  answer(last_request(), {{two, 7}});
  const auto d = decisions();
  REQUIRE(d.size() == 2);
  CHECK(std::ranges::count(d, true, &decision_record::accepted) == 1);
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world,
                  "an acceptance without a manager counts as a refusal") {
  offer({one, two});
  tell(requester,
       service_response{
           here,
           station,
           last_request().number,
           {{at_here(one, 7), true, ""}, {at_here(two, 8), true, ""}}},
       std::vector{manager.handle});
  const auto d = decisions();
  REQUIRE(d.size() == 2);
  CHECK(std::ranges::count(d, true, &decision_record::accepted) == 1);
  run_for(3s);
  CHECK(episodes().size() == 1); // no_data of the first
}

TEST_CASE_FIXTURE(requester_world,
                  "a service nobody asked for is ended when it is accepted") {
  offer({one});
  answer(last_request(), {{one, 7}, {two, 8}});
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(two, 8));
  CHECK(ends().front().from == side::requester);
}

// -- time-outs ---------------------------------------------------------------

TEST_CASE_FIXTURE(requester_world,
                  "a request is open for half a second, exactly") {
  offer({one});
  run_for(500ms - 1ns);
  CHECK(decisions().empty());
  run_for(1ns);
  REQUIRE(decisions().size() == 1);
  CHECK(!decisions().front().accepted);
  CHECK(decisions().front().at == now());
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world, "a response just in time is a response") {
  offer({one});
  run_for(500ms - 1ns);
  answer(last_request(), {{one, 7}});
  run_for(1ns);
  REQUIRE(decisions().size() == 1);
  CHECK(decisions().front().accepted);
  CHECK(ends().empty());
}

TEST_CASE_FIXTURE(requester_world, "the time-out of an answered request does "
                                   "not end the next one") {
  offer({one});
  run_for(300ms);
  answer(last_request(), {{one, 0}});
  offer({one});
  run_for(400ms); // the first would have timed out
  CHECK(decisions().size() == 1);
  answer(last_request(), {{one, 7}});
  CHECK(decisions().back().accepted);
}

TEST_CASE_FIXTURE(requester_world,
                  "a response that comes too late is answered by service_end") {
  offer({one});
  run_for(500ms);
  answer(last_request(), {{one, 7}});
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  CHECK(ends().front().from == side::requester);
  CHECK(decisions().size() == 1);
  result(at_here(one, 7), 1);
  CHECK(!is_remote(one));
  run_for(3s);
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(requester_world, "a late response does not answer the "
                                   "request that is open now") {
  offer({one});
  const auto first = last_request();
  run_for(600ms);
  offer({one});
  REQUIRE(requests() == 2);
  answer(first, {{one, 7}});
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  answer(last_request(), {{one, 8}});
  CHECK(decisions().back().accepted);
  CHECK(ends().size() == 1);
}

TEST_CASE_FIXTURE(requester_world, "a late refusal needs no answer") {
  offer({one});
  run_for(600ms);
  answer(last_request(), {{one, 0}});
  CHECK(ends().empty());
  CHECK(decisions().size() == 1);
}

TEST_CASE_FIXTURE(requester_world,
                  "a response that comes twice does not end what runs") {
  start({one});
  answer(last_request(), {{one, 7}});
  CHECK(ends().empty());
  result(at_here(one, 7), 1);
  answer(last_request(), {{one, 7}});
  CHECK(ends().empty());
  CHECK(decisions().size() == 1);
  CHECK(is_remote(one));
  run_for(50ms);
  result(at_here(one, 7), 2);
  CHECK(is_remote(one));
}

TEST_CASE_FIXTURE(requester_world,
                  "without data an accepted service ends after a second, "
                  "exactly") {
  start({one});
  const auto accepted = now();
  run_for(1s - 1ns);
  CHECK(episodes().empty());
  CHECK(ends().empty());
  run_for(1ns);
  REQUIRE(ends().size() == 1);
  CHECK(ends().front().session == at_here(one, 7));
  CHECK(ends().front().reason == end_reason::no_data);
  REQUIRE(episodes().size() == 1);
  const auto e = episodes().front();
  CHECK(e.session == at_here(one, 7));
  CHECK(e.of == side::requester);
  CHECK(e.reason == end_reason::no_data);
  CHECK(!e.got_data);
  CHECK(e.accepted == accepted);
  CHECK(e.ended == accepted + 1s);
  CHECK(!e.fallback); // the local service never stopped
}

TEST_CASE_FIXTURE(requester_world, "who accepts and gives no data is not asked "
                                   "for a second, and the policy hears of "
                                   "it") {
  start({one});
  run_for(1s);
  REQUIRE(episodes().size() == 1);
  REQUIRE(lodm->cycles.size() == 1);
  CHECK(lodm->cycles.back().missed);
  CHECK(lodm->cycles.back().computed_at == here);
  offer({one});
  run_for(1s - 1ns);
  offer({one});
  CHECK(requests() == 1);
  run_for(1ns);
  offer({one});
  CHECK(requests() == 2);
}

TEST_CASE_FIXTURE(requester_world,
                  "data just in time keeps an accepted service") {
  start({one});
  run_for(1s - 1ns);
  result(at_here(one, 7), 1);
  run_for(50ms);
  CHECK(is_remote(one));
  CHECK(episodes().empty());
}

TEST_CASE_FIXTURE(requester_world, "late data is no data") {
  start({one});
  for (std::uint64_t k = 1; k <= 20; ++k) {
    run_for(50ms);
    result(at_here(one, 7), k, 60ms);
  }
  CHECK(!is_remote(one));
  REQUIRE(episodes().size() == 1);
  CHECK(episodes().front().reason == end_reason::no_data);
}

TEST_CASE_FIXTURE(requester_world,
                  "the first data makes the service remote at that instant") {
  start({one});
  run_for(123ms);
  result(at_here(one, 7), 1);
  CHECK(is_remote(one));
  CHECK(vehicle->times<source_change>().back() == now());
}

TEST_CASE_FIXTURE(requester_world,
                  "an acceptance in somebody else's name is not believed") {
  const session_id lies[] = {
      {here, station, one, 0}, // the local service goes by this name
      {elsewhere, station, one, 7},
      {here, station + 1, one, 7},
  };
  for (const auto& lie : lies) {
    offer({one});
    tell(requester,
         service_response{
             here, station, last_request().number, {{lie, true, ""}}},
         std::vector{manager.handle});
    REQUIRE(!decisions().empty());
    CHECK(!decisions().back().accepted);
    vehicle->clear();
    result(lie, 1000, 0ms);
    CHECK(vehicle->count<source_change>() == 0);
    run_for(2s);
  }
  CHECK(episodes().empty());
}
