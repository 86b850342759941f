// What a vehicle's requester may do, by its steps.
#include "tests/experiments/written_trace.hpp"

#include <doctest/doctest.h>

namespace sofof::test::traces {

TEST_CASE_FIXTURE(running_vehicle, "a session that is offered, asked for, "
                                   "accepted, used and closed breaks no rule") {
  vehicle(first_data);
  pass(10s);
  vehicle(violation);
  vehicle(closed, session, "qos_gap");
  vehicle(end_sent, session, "qos_gap");
  pass(1s);
  vehicle(offer_got, plan);
  vehicle(request_sent, plan, {}, 2);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "who closes a session tells the provider") {
  vehicle(first_data);
  vehicle(closed, session, "released");
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V9"});
}

TEST_CASE_FIXTURE(running_vehicle, "who has heard of an end tells nobody") {
  vehicle(end_got, session, "left_area");
  vehicle(closed, session, "left_area");
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "a violation closes its session at once") {
  vehicle(first_data);
  vehicle(violation);
  pass(1ms);
  vehicle(closed, session, "qos_gap");
  vehicle(end_sent, session, "qos_gap");
  CHECK(broken() == rules{"V8", "V20"});
}

TEST_CASE_FIXTURE(running_vehicle, "a session without data is closed after a "
                                   "second") {
  pass(951ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V7"});
}

TEST_CASE("nobody is asked within its cool-down, which is only after a fault") {
  const auto ask_soon_after = [](const char* reason) {
    running_vehicle x;
    x.vehicle(end_got, session, reason);
    x.vehicle(closed, session, reason);
    x.pass(999ms);
    x.vehicle(offer_got, plan);
    x.vehicle(request_sent, plan, {}, 2);
    return x.broken();
  };
  CHECK(ask_soon_after("left_area").empty());
  CHECK(ask_soon_after("qos_gap") == rules{"V5"});
}

TEST_CASE_FIXTURE(traced, "what is not offered is not asked for") {
  vehicle(request_sent, plan);
  CHECK(broken() == rules{"V3"});
}

TEST_CASE_FIXTURE(traced, "an offer that is too old is none") {
  vehicle(offer_got, plan);
  pass(2501ms);
  vehicle(request_sent, plan);
  CHECK(broken() == rules{"V3"});
}

TEST_CASE_FIXTURE(traced, "a request is over after half a second") {
  vehicle(offer_got, plan);
  vehicle(request_sent, plan);
  pass(500ms);
  vehicle(request_over, none);
  vehicle(offer_got, plan);
  vehicle(request_sent, plan, {}, 2);
  pass(501ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V4"});
}

TEST_CASE_FIXTURE(traced, "a late acceptance is ended") {
  vehicle(offer_got, plan);
  vehicle(request_sent, plan);
  pass(500ms);
  vehicle(request_over, none);
  vehicle(response_got, session);
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V6"});
}

TEST_CASE_FIXTURE(traced, "who is lost need not be told that its acceptance "
                          "is late") {
  vehicle(offer_got, plan);
  vehicle(request_sent, plan);
  vehicle(peer_lost, none);
  vehicle(response_got, session);
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "two digests that do not name a session end "
                                   "it, and a copy of the first one does not") {
  vehicle(first_data);
  vehicle(digest_got, none, {}, 7);
  pass(20ms);
  vehicle(digest_got, none, {}, 7);
  pass(480ms);
  CHECK(checker.finish().empty());
  vehicle(digest_got, none, {}, 7);
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V8"});
}

TEST_CASE_FIXTURE(running_vehicle, "a digest that is older than a session says "
                                   "nothing of it") {
  vehicle(first_data);
  for (int k = 0; k < 3; ++k) {
    pass(500ms);
    vehicle(digest_got, none, {}, 6);
  }
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(traced, "a session begins with an acceptance") {
  vehicle(begun);
  CHECK(broken() == rules{"V12"});
}

TEST_CASE("what moves is not asked for elsewhere, but by the same decision") {
  const auto asks_another_after = [](duration d, bool has_data) {
    traced x;
    const auto another = [&](trace_step what, std::uint64_t number) {
      x.checker.add({.at = x.now,
                     .by = trace_part::requester,
                     .step = ++x.last[trace_part::requester],
                     .what = what,
                     .provider = 4,
                     .station = car,
                     .number = number,
                     .services = plan},
                    {0, x.checker.steps() + 1});
    };
    another(offer_got, 0);
    x.vehicle(offer_got, plan);
    x.vehicle(request_sent, plan);
    if (has_data) {
      x.vehicle(response_got);
      x.vehicle(begun);
      x.vehicle(first_data);
    }
    x.pass(d);
    another(request_sent, 2);
    return x.broken();
  };
  CHECK(asks_another_after(0ms, false).empty());
  CHECK(asks_another_after(50ms, true).empty());
  CHECK(asks_another_after(50ms, false) == rules{"V19"});
}

TEST_CASE_FIXTURE(traced, "a provider is forgotten when its peer speaks for "
                          "another one, and only then") {
  const auto meet = [&](provider_id id, std::uint64_t peer) {
    checker.add({.at = now,
                 .by = trace_part::requester,
                 .step = ++last[trace_part::requester],
                 .what = met,
                 .provider = id,
                 .station = car,
                 .number = peer},
                {0, checker.steps() + 1});
  };
  meet(server, 1);
  meet(4, 2);
  CHECK(checker.finish().empty());
  SUBCASE("as it should be") {
    meet(5, 1);
    vehicle(forgotten, none);
    pass(1ms);
    meet(6, 3);
    CHECK(broken().empty());
  }
  SUBCASE("it is not forgotten") {
    meet(5, 1);
    pass(1ms);
    meet(6, 3);
    CHECK(broken() == rules{"V18"});
  }
  SUBCASE("it is forgotten for a stranger") {
    meet(5, 3);
    vehicle(forgotten, none);
    CHECK(broken() == rules{"V18"});
  }
}

// -- one broken rule each -----------------------------------------------------

TEST_CASE_FIXTURE(traced, "request numbers rise by one") {
  vehicle(offer_got, plan);
  vehicle(request_sent, plan, {}, 2);
  CHECK(broken() == rules{"V1"});
}

TEST_CASE_FIXTURE(traced, "a provider is not asked while a request is open") {
  vehicle(offer_got, plan);
  vehicle(request_sent, plan);
  pass(499ms);
  vehicle(offer_got, plan);
  vehicle(request_sent, plan, {}, 2);
  CHECK(broken() == rules{"V2"});
}

TEST_CASE_FIXTURE(running_vehicle, "results of no session are answered, but "
                                   "not within 200 ms again") {
  vehicle(first_data);
  vehicle(result_refused, {{"plan", 6}});
  vehicle(end_sent, {{"plan", 6}}, "no_data");
  pass(199ms);
  vehicle(result_refused, {{"plan", 6}});
  pass(1ms);
  CHECK(checker.finish().empty());
  vehicle(result_refused, {{"plan", 6}});
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V10"});
}

TEST_CASE_FIXTURE(running_vehicle, "a session that only a digest has is "
                                   "ended") {
  vehicle(first_data);
  vehicle(digest_got, {{"plan", 6}}, {}, 7);
  pass(1ms);
  vehicle(offer_got, plan);
  CHECK(broken() == rules{"V11"});
}

TEST_CASE_FIXTURE(running_vehicle, "a session's counter is above the last "
                                   "one's") {
  vehicle(end_got, session, "left_area");
  vehicle(closed, session, "left_area");
  vehicle(offer_got, plan);
  vehicle(request_sent, plan, {}, 2);
  vehicle(response_got, session, {}, 2);
  vehicle(begun);
  CHECK(broken() == rules{"V13"});
}

TEST_CASE_FIXTURE(running_vehicle, "first data come once") {
  vehicle(first_data);
  vehicle(first_data);
  CHECK(broken() == rules{"V14"});
}

TEST_CASE_FIXTURE(running_vehicle, "results of a session that runs are not "
                                   "refused") {
  vehicle(result_refused);
  CHECK(broken() == rules{"V15"});
}

TEST_CASE_FIXTURE(running_vehicle, "a provider is not told to end what runs "
                                   "on") {
  vehicle(end_sent, session, "released");
  CHECK(broken() == rules{"V16"});
}

TEST_CASE_FIXTURE(running_vehicle, "a vehicle closes a session once") {
  vehicle(end_got, session, "left_area");
  vehicle(closed, session, "left_area");
  vehicle(closed, session, "left_area");
  CHECK(broken() == rules{"V17"});
}

// -- why a session ends -------------------------------------------------------

TEST_CASE("a session that gives data ends for no reason but a decision") {
  for (const auto* reason :
       {"left_area", "cam_timeout", "qos_latency", "qos_input_age", "qos_gap",
        "no_data", "refused", "peer_lost", "handed_over", "revoked",
        "implausible", "shutdown"}) {
    CAPTURE(reason);
    running_vehicle x;
    x.vehicle(first_data);
    x.pass(2s);
    x.vehicle(closed, session, reason);
    CHECK(x.broken() == rules{"V20"});
  }
  running_vehicle released;
  released.vehicle(first_data);
  released.vehicle(closed, session, "released");
  CHECK(released.broken().empty());
}

TEST_CASE("a session ends for the reason that its instant gives") {
  const auto ends = [](trace_step cause, const char* said, const char* reason) {
    running_vehicle x;
    const auto of_all = cause == peer_lost || cause == shut_down;
    x.vehicle(cause, of_all ? none : session, said);
    x.vehicle(closed, session, reason);
    return x.broken();
  };
  CHECK(ends(violation, "", "qos_gap").empty());
  CHECK(ends(violation, "", "implausible").empty());
  CHECK(ends(violation, "", "no_data") == rules{"V20"});
  CHECK(ends(end_got, "revoked", "revoked").empty());
  CHECK(ends(end_got, "revoked", "left_area") == rules{"V20"});
  CHECK(ends(peer_lost, "", "peer_lost").empty());
  CHECK(ends(peer_lost, "", "no_data") == rules{"V20"});
  CHECK(ends(offer_got, "", "handed_over") == rules{"V20"}); // without data
  CHECK(ends(offer_got, "", "released").empty()); // its start is given up
}

TEST_CASE_FIXTURE(running_vehicle, "a session that shuts down with its vehicle "
                                   "says so") {
  vehicle(shut_down, none);
  vehicle(closed, session, "shutdown");
  vehicle(end_sent, session, "shutdown");
  CHECK(broken().empty());
}

TEST_CASE("a session that waits for first data ends after a second, not "
          "earlier") {
  const auto ends_after = [](duration d) {
    running_vehicle x; // for 50 ms
    x.pass(d - 50ms);
    x.vehicle(closed, session, "no_data");
    return x.broken();
  };
  CHECK(ends_after(1s).empty());
  CHECK(ends_after(1s - 1ns) == rules{"V20"});
}

TEST_CASE("a session ends 2.25 s after the last digest that names it, not "
          "earlier") {
  const auto ends_after = [](duration d) {
    running_vehicle x;
    x.vehicle(first_data);
    x.pass(1s);
    x.vehicle(digest_got, session, {}, 7);
    x.pass(d);
    x.vehicle(closed, session, "no_data");
    return x.broken();
  };
  CHECK(ends_after(2250ms).empty());
  CHECK(ends_after(2250ms - 1ns) == rules{"V20"});
}

TEST_CASE("a session is handed over to another provider that gives data") {
  const auto hands_over = [](bool has_data) {
    running_vehicle x;
    x.vehicle(first_data);
    const auto another = [&](trace_step what,
                             std::vector<traced_service> of = {{"plan", 2}}) {
      x.checker.add({.at = x.now,
                     .by = trace_part::requester,
                     .step = ++x.last[trace_part::requester],
                     .what = what,
                     .provider = 4,
                     .station = car,
                     .number = 2,
                     .services = std::move(of)},
                    {0, x.checker.steps() + 1});
    };
    another(offer_got, plan);
    another(request_sent, plan);
    another(response_got);
    another(begun);
    if (has_data)
      another(first_data);
    x.vehicle(closed, session, "handed_over");
    return x.broken();
  };
  CHECK(hands_over(true).empty());
  CHECK(hands_over(false) == rules{"V20"});
}
} // namespace sofof::test::traces
