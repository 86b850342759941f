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

TEST_CASE_FIXTURE(running_provider, "a request is answered within half a "
                                    "second, unless another one comes") {
  provider(request_got, {{"map", 0}}, {}, 2);
  pass(400ms);
  provider(request_got, {{"map", 0}}, {}, 3);
  pass(100ms);
  provider(digest_sent);
  pass(400ms);
  CHECK(checker.finish().empty());
  provider(heard, none, "inside");
  CHECK(checker.finish().empty());
  pass(1ns);
  provider(heard, none, "inside");
  CHECK(broken() == rules{"P4"});
}

TEST_CASE_FIXTURE(traced, "a station that is not heard is refused at once") {
  provider(request_got, plan);
  pass(1ns);
  provider(request_got, plan);
  provider(response_sent, plan);
  CHECK(broken() == rules{"P4"});
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

// -- why a session ends -------------------------------------------------------

TEST_CASE("a session ends for no reason at no provider") {
  for (const auto* reason : {"cam_timeout", "qos_gap", "no_data", "peer_lost",
                             "released", "revoked", "shutdown"}) {
    CAPTURE(reason);
    running_provider x;
    x.provider(closed, first_session, reason);
    x.provider(end_sent, first_session, reason);
    x.pass(1ns);
    x.provider(heard, none, "inside");
    CHECK(x.broken() == rules{"P17"});
  }
}

TEST_CASE("a session ends for the reason that the vehicle says, or that its "
          "function was lost for") {
  const auto ends = [](trace_step cause, const char* said, const char* reason) {
    running_provider x;
    x.provider(cause, first_session, said);
    x.provider(closed, first_session, reason);
    return x.broken();
  };
  CHECK(ends(end_got, "qos_gap", "qos_gap").empty());
  CHECK(ends(function_lost, "no_data", "no_data").empty());
  CHECK(ends(end_got, "qos_gap", "released") == rules{"P17"});
}

TEST_CASE_FIXTURE(running_provider, "a session is revoked by a decision about "
                                    "others, which is told in this instant") {
  provider(closed, first_session, "revoked");
  provider(end_sent, first_session, "revoked");
  provider(request_got, {{"map", 0}}, {}, 2);
  provider(response_sent, {{"map", 0}}, {}, 2);
  pass(1ms);
  provider(heard, none, "inside");
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_provider, "a new requester ends what ran for the one "
                                    "before") {
  provider(heard, none, "inside");
  provider(closed, first_session, "peer_lost");
  provider(end_sent, first_session, "peer_lost");
  provider(met, none, {}, 2);
  pass(1ms);
  provider(heard, none, "inside");
  CHECK(broken().empty());
}

TEST_CASE("what a station asks for anew does not run there, and it is answered "
          "at once") {
  const auto ends = [](const char* asked, duration answered_after) {
    running_provider x;
    x.provider(request_got, {{asked, 0}}, {}, 2);
    x.provider(closed, first_session, "no_data");
    x.provider(end_sent, first_session, "no_data");
    x.pass(answered_after);
    x.provider(response_sent, {{asked, 0}}, {}, 2);
    return x.broken();
  };
  CHECK(ends("plan", 0ms).empty());
  CHECK(ends("plan", 1ms) == rules{"P17"});
  CHECK(ends("map", 0ms) == rules{"P17"});
}

TEST_CASE("a station is forgotten for a reason") {
  const auto forgets = [](trace_step cause, const char* said,
                          const char* reason) {
    traced x;
    x.provider(heard, none, "inside");
    x.provider(met, none);
    x.provider(cause, none, said);
    x.provider(forgotten, none, reason);
    return x.broken();
  };
  CHECK(forgets(peer_lost, "peer_lost", "peer_lost").empty());
  CHECK(forgets(peer_lost, "shutdown", "shutdown").empty());
  CHECK(forgets(shut_down, "", "shutdown").empty());
  CHECK(forgets(peer_lost, "shutdown", "peer_lost") == rules{"P17"});
  CHECK(forgets(heard, "outside", "left_area") == rules{"P17"});
  CHECK(forgets(heard, "inside", "peer_lost") == rules{"P17"});
  CHECK(forgets(heard, "inside", "cam_timeout") == rules{"P12"});
}
} // namespace sofof::test::traces
