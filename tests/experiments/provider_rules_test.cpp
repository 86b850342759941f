// What a provider may do, by its steps.
#include "tests/experiments/written_trace.hpp"

#include <doctest/doctest.h>

namespace sofof::test::traces {

TEST_CASE_FIXTURE(running_provider, "a provider that tells of what runs, ends "
                                    "it and goes on telling breaks no rule") {
  pass(500ms);
  provider(digest_sent);
  pass(200ms);
  provider(heard, none, "outside");
  provider(closed, first_session, "left_area");
  provider(end_sent, first_session, "left_area");
  for (int k = 0; k < 5; ++k) {
    pass(k == 0 ? 300ms : 500ms);
    provider(digest_sent, none);
    provider(heard, none, "outside");
  }
  pass(2s + 1ns);
  provider(forgotten, none, "cam_timeout");
  provider(shut_down, none);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_provider, "a digest that does not come is missed") {
  pass(501ms);
  provider(heard, none, "inside");
  CHECK(broken() == rules{"P10"});
}

TEST_CASE_FIXTURE(running_provider, "a digest names what runs") {
  pass(500ms);
  provider(digest_sent, none);
  CHECK(broken() == rules{"P11"});
}

TEST_CASE_FIXTURE(running_provider, "who is outside loses what runs") {
  provider(heard, none, "outside");
  pass(1ms);
  provider(heard, none, "outside");
  CHECK(broken() == rules{"P8"});
}

TEST_CASE_FIXTURE(running_provider, "who is silent for two seconds is "
                                    "forgotten") {
  for (int k = 0; k < 5; ++k) {
    pass(500ms);
    provider(digest_sent);
  }
  CHECK(broken() == rules{"P12"});
}

TEST_CASE_FIXTURE(running_provider, "whose requester is lost is forgotten at "
                                    "once") {
  provider(peer_lost, none);
  pass(1ms);
  provider(heard, none, "inside");
  CHECK(broken() == rules{"P16"});
}

TEST_CASE_FIXTURE(running_provider, "a request is answered once, and a "
                                    "repeated one not at all") {
  provider(request_got, plan);
  provider(response_sent);
  CHECK(broken() == rules{"P4"});
}

TEST_CASE_FIXTURE(running_provider, "what runs is not offered") {
  pass(1s);
  provider(offer_sent, plan);
  CHECK(broken() == rules{"P10", "P3"});
}

TEST_CASE_FIXTURE(running_provider, "nothing runs when a provider has ended in "
                                    "good order") {
  provider(shut_down, none);
  CHECK(broken() == rules{"P8"});
}

// -- one broken rule each -----------------------------------------------------

TEST_CASE_FIXTURE(traced, "a station that is not heard gets no offer") {
  provider(offer_sent, plan);
  CHECK(broken() == rules{"P1"});
}

TEST_CASE_FIXTURE(traced, "a station gets one offer a second") {
  provider(heard, none, "inside");
  provider(offer_sent, plan);
  pass(999ms);
  provider(offer_sent, plan);
  CHECK(broken() == rules{"P2"});
}

TEST_CASE_FIXTURE(running_provider, "what is accepted runs") {
  provider(request_got, {{"map", 0}}, {}, 2);
  provider(response_sent, {{"map", 2}}, {}, 2);
  CHECK(broken() == rules{"P5"});
}

TEST_CASE_FIXTURE(traced, "a session begins with a request") {
  provider(heard, none, "inside");
  provider(begun, first_session, "inside");
  CHECK(broken() == rules{"P6"});
}

TEST_CASE_FIXTURE(running_provider, "no counter is left out") {
  provider(request_got, {{"map", 0}}, {}, 2);
  provider(begun, {{"map", 3}}, "inside");
  provider(response_sent, {{"map", 3}}, {}, 2);
  CHECK(broken() == rules{"P7"});
}

TEST_CASE_FIXTURE(running_provider, "a vehicle is told what its provider "
                                    "closes") {
  provider(heard, none, "outside");
  provider(closed, first_session, "left_area");
  pass(1ms);
  provider(heard, none, "outside");
  CHECK(broken() == rules{"P9"});
}

TEST_CASE_FIXTURE(running_provider, "a vehicle is not told of an end of what "
                                    "runs on") {
  provider(end_sent, first_session, "revoked");
  CHECK(broken() == rules{"P13"});
}

TEST_CASE_FIXTURE(running_provider, "a provider closes a session once") {
  provider(end_got, first_session, "released");
  provider(closed, first_session, "released");
  provider(closed, first_session, "released");
  CHECK(broken() == rules{"P14"});
}

TEST_CASE_FIXTURE(running_provider, "a station that has come back has not left "
                                    "the area") {
  provider(heard, none, "outside");
  provider(heard, none, "inside");
  provider(closed, first_session, "left_area");
  CHECK(broken() == rules{"P15"});
}

} // namespace sofof::test::traces
