// Tests of the service requester: requests and refusals that name other
// providers.
#include "base/protocol.hpp"
#include "tests/actors/requester_world.hpp"

#include <algorithm>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE_FIXTURE(requester_world, "a request tells whom else the vehicle "
                                   "could ask, and the one that is asked") {
  lodm->wanted = {};
  tell_as(other.handle, requester,
          service_offer{elsewhere, {500, 20}, {one}, 0.75});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  tell_as(provider.handle, requester,
          service_offer{here, {500, 20}, {one}, 0.25, 2, 10ms});
  const auto told = last_request().candidates;
  REQUIRE(told.size() == 2);
  CHECK(told[0].provider == here);
  CHECK(told[0].utilisation == 0.25);
  CHECK(told[1].provider == elsewhere);
  CHECK(told[1].utilisation == 0.75);
  // It computes for 10 ms of 50: lambda_T 10 / 50 more.
  CHECK(told[0].gain == doctest::Approx(told[1].gain - 0.3 * 10 / 50));
}

TEST_CASE_FIXTURE(requester_world, "a request does not tell of a provider that "
                                   "the LODM would not ask") {
  lodm->wanted = {};
  offer_from(other, elsewhere, {one});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  lodm->unwanted = {here, elsewhere};
  offer({one});
  const auto told = last_request().candidates;
  REQUIRE(told.size() == 1);
  CHECK(told.front().provider == here); // it does ask this one
}

TEST_CASE_FIXTURE(requester_world, "of more providers than a request may name "
                                   "it names the nearest") {
  lodm->wanted = {};
  drive_to(0);
  std::vector<probe<provider_actor>> all;
  for (provider_id::rep k = 1; k <= 2 * protocol::most_candidates; ++k) {
    all.push_back(listen<provider_actor>());
    // Those with odd ids are near.
    tell_as(all.back().handle, requester,
            service_offer{1000 + k, {k % 2 == 1 ? 100. : 900., 0}, {one}, 0.5});
  }
  lodm->wanted = {"one"};
  lodm->preferred = here;
  tell_as(provider.handle, requester,
          service_offer{here, {50, 0}, {one}, 0.25, 2, 10ms});
  const auto told = last_request().candidates;
  REQUIRE(told.size() == protocol::most_candidates);
  CHECK(std::ranges::count(told, here, &candidate::provider) == 1);
  CHECK(std::ranges::is_sorted(told, {}, &candidate::provider));
  for (const auto& c : told)
    CHECK((c.provider == here || c.provider.value() % 2 == 1));
}

TEST_CASE_FIXTURE(requester_world, "who asks to leave a provider does not tell "
                                   "what it would win by staying") {
  start_remote({one});
  lodm->preferred = elsewhere;
  offer_from(other, elsewhere, {one});
  REQUIRE(other->count<service_request>() == 1);
  const auto told = other->all<service_request>().front().candidates;
  REQUIRE(told.size() == 1);
  CHECK(told.front().provider == elsewhere);
}

namespace {

void refuse_and_name(requester_world& world, const service_request& request,
                     provider_id instead) {
  service_response response{
      request.provider, world.station, request.number, {}};
  for (const auto& kind : request.services)
    response.verdicts.push_back(
        {{request.provider, world.station, kind, 0}, false, "full", instead});
  world.tell(world.requester, response, std::vector<provider_manager_actor>{});
}

} // namespace

TEST_CASE_FIXTURE(requester_world, "who is named in a refusal is asked at "
                                   "once, if it offers") {
  lodm->wanted = {};
  offer_from(other, elsewhere, {one});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  offer({one});
  REQUIRE(requests() == 1);
  CHECK(other->count<service_request>() == 0);
  run_for(100ms);
  lodm->preferred = elsewhere;
  refuse_and_name(*this, last_request(), elsewhere);
  REQUIRE(other->count<service_request>() == 1);
  CHECK(other->times<service_request>().front() == now());
  const auto second = other->all<service_request>().front();
  CHECK(second.provider == elsewhere);
  CHECK(second.services == std::vector{one});
  // They could send it back and forth.
  refuse_and_name(*this, second, here);
  CHECK(requests() == 1);
  CHECK(other->count<service_request>() == 1);
}

TEST_CASE_FIXTURE(requester_world, "who is named in a refusal is not asked if "
                                   "the vehicle decides otherwise") {
  lodm->wanted = {};
  offer_from(other, elsewhere, {one});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  offer({one});
  REQUIRE(requests() == 1);
  refuse_and_name(*this, last_request(), elsewhere);
  CHECK(other->count<service_request>() == 0);
}

TEST_CASE_FIXTURE(requester_world, "who is named but unknown, busy or itself "
                                   "is not asked") {
  for (const provider_id name :
       {provider_id{0}, provider_id{99}, provider_id{here}}) {
    offer({one});
    const auto before = requests();
    refuse_and_name(*this, last_request(), name);
    CHECK(requests() == before);
  }
  // Itself, which has offered once more before it refused.
  offer({one});
  const auto before = requests();
  offer({one});
  refuse_and_name(*this, last_request(), here);
  CHECK(requests() == before);
  // Its offer was of something else.
  lodm->wanted = {};
  offer_from(other, elsewhere, {two});
  lodm->wanted = {"one"};
  offer({one});
  refuse_and_name(*this, last_request(), elsewhere);
  CHECK(other->count<service_request>() == 0);
  CHECK(!is_gone(requester));
}

TEST_CASE_FIXTURE(requester_world, "who is named in a refusal is not asked "
                                   "while another request of the service is "
                                   "open") {
  constexpr provider_id third = 33;
  const auto last = listen<provider_actor>();
  lodm->wanted = {};
  offer_from(other, elsewhere, {one});
  offer_from(last, third, {one});
  lodm->wanted = {"one"};
  lodm->preferred = here;
  lodm->second = elsewhere;
  offer({one});
  REQUIRE(requests() == 1);
  REQUIRE(other->count<service_request>() == 1);
  lodm->preferred = third;
  lodm->second = std::nullopt;
  refuse_and_name(*this, last_request(), third);
  CHECK(last->count<service_request>() == 0);
  // The one that was asked besides is wanted still.
  const session_id there{elsewhere, station, one, 70};
  tell(requester,
       service_response{elsewhere,
                        station,
                        other->all<service_request>().back().number,
                        {{there, true, "as told"}}},
       std::vector{manager.handle});
  result(there, 1);
  CHECK(is_remote(one));
  CHECK(other->count<service_end>() == 0);
}
