// Tests of the checker of traces: which steps it lets pass, and which rule it
// finds broken.
#include "experiments/conformance/trace_checker.hpp"

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::experiments::conformance;
using namespace std::chrono_literals;

namespace {

constexpr provider_id server = 3;
constexpr station_id car = 101;
const std::vector<traced_service> none{};
const std::vector<traced_service> plan{{"plan", 0}};
const std::vector<traced_service> session{{"plan", 7}};
const std::vector<traced_service> first_session{{"plan", 1}};

/// A trace that is written step by step.
struct traced {
  trace_checker checker{duration{0}};
  time_point now{1s};
  std::map<trace_part, std::uint64_t> last;

  void pass(duration d) { now += d; }

  traced& add(trace_part by, trace_step what,
              std::vector<traced_service> services = session,
              std::string detail = {}, std::uint64_t number = 1) {
    checker.add({.at = now,
                 .by = by,
                 .step = ++last[by],
                 .what = what,
                 .provider = server,
                 .station = car,
                 .number = number,
                 .services = std::move(services),
                 .detail = std::move(detail)},
                {0, checker.steps() + 1});
    return *this;
  }
  traced& vehicle(trace_step what,
                  std::vector<traced_service> services = session,
                  std::string detail = {}, std::uint64_t number = 1) {
    return add(trace_part::requester, what, std::move(services),
               std::move(detail), number);
  }
  traced& provider(trace_step what,
                   std::vector<traced_service> services = first_session,
                   std::string detail = {}, std::uint64_t number = 1) {
    return add(trace_part::provider, what, std::move(services),
               std::move(detail), number);
  }
  traced& selector(trace_step what,
                   std::vector<traced_service> services = session,
                   std::uint64_t number = 1, std::string detail = {}) {
    return add(trace_part::selector, what, std::move(services),
               std::move(detail), number);
  }
  /// It ends, for that reason, and the own function goes on.
  void come_home(const char* reason) {
    selector(trace_step::end_got, session, 0, reason);
    selector(trace_step::unwatched);
    selector(trace_step::source, plan);
  }

  /// @returns the names of the rules that were broken ("V9").
  std::vector<std::string> broken() {
    std::vector<std::string> all;
    for (const auto& x : checker.finish())
      all.push_back(std::string{x.broken.id});
    return all;
  }
};

using rules = std::vector<std::string>;

/// The vehicle's session 7 has begun.
struct running_vehicle : traced {
  running_vehicle() {
    vehicle(trace_step::offer_got, plan);
    vehicle(trace_step::request_sent, plan);
    pass(20ms);
    vehicle(trace_step::response_got, session);
    vehicle(trace_step::begun);
    pass(50ms);
  }
};

/// The provider's session 1 has begun.
struct running_provider : traced {
  running_provider() {
    provider(trace_step::heard, none, "inside");
    provider(trace_step::met, none);
    provider(trace_step::offer_sent, plan);
    provider(trace_step::request_got, plan);
    provider(trace_step::begun, first_session, "inside");
    provider(trace_step::response_sent);
  }
};

/// Results of session 7 are in use.
struct running_selector : traced {
  running_selector() {
    selector(trace_step::used, plan);
    selector(trace_step::begun);
    pass(100ms);
    selector(trace_step::first_data);
    selector(trace_step::watched);
    selector(trace_step::source);
    selector(trace_step::used);
    pass(100ms);
  }
};

} // namespace

// -- the requester ------------------------------------------------------------

TEST_CASE_FIXTURE(running_vehicle, "a session that is offered, asked for, "
                                   "accepted, used and closed breaks no rule") {
  vehicle(trace_step::first_data);
  pass(10s);
  vehicle(trace_step::violation);
  vehicle(trace_step::closed, session, "qos_gap");
  vehicle(trace_step::end_sent, session, "qos_gap");
  pass(1s);
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::request_sent, plan, {}, 2);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "who closes a session tells the provider") {
  vehicle(trace_step::first_data);
  vehicle(trace_step::closed, session, "released");
  pass(1ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken() == rules{"V9"});
}

TEST_CASE_FIXTURE(running_vehicle, "who has heard of an end tells nobody") {
  vehicle(trace_step::end_got, session, "left_area");
  vehicle(trace_step::closed, session, "left_area");
  pass(1ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "a violation closes its session at once") {
  vehicle(trace_step::first_data);
  vehicle(trace_step::violation);
  pass(1ms);
  vehicle(trace_step::closed, session, "qos_gap");
  vehicle(trace_step::end_sent, session, "qos_gap");
  CHECK(broken() == rules{"V8"});
}

TEST_CASE_FIXTURE(running_vehicle, "a session without data is closed after a "
                                   "second") {
  pass(951ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken() == rules{"V7"});
}

TEST_CASE("nobody is asked within its cool-down, which is only after a fault") {
  const auto ask_soon_after = [](const char* reason) {
    running_vehicle x;
    x.vehicle(trace_step::end_got, session, reason);
    x.vehicle(trace_step::closed, session, reason);
    x.pass(999ms);
    x.vehicle(trace_step::offer_got, plan);
    x.vehicle(trace_step::request_sent, plan, {}, 2);
    return x.broken();
  };
  CHECK(ask_soon_after("left_area").empty());
  CHECK(ask_soon_after("qos_gap") == rules{"V5"});
}

TEST_CASE_FIXTURE(traced, "what is not offered is not asked for") {
  vehicle(trace_step::request_sent, plan);
  CHECK(broken() == rules{"V3"});
}

TEST_CASE_FIXTURE(traced, "an offer that is too old is none") {
  vehicle(trace_step::offer_got, plan);
  pass(2501ms);
  vehicle(trace_step::request_sent, plan);
  CHECK(broken() == rules{"V3"});
}

TEST_CASE_FIXTURE(traced, "a request is over after half a second") {
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::request_sent, plan);
  pass(500ms);
  vehicle(trace_step::request_over, none);
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::request_sent, plan, {}, 2);
  pass(501ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken() == rules{"V4"});
}

TEST_CASE_FIXTURE(traced, "a late acceptance is ended") {
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::request_sent, plan);
  pass(500ms);
  vehicle(trace_step::request_over, none);
  vehicle(trace_step::response_got, session);
  pass(1ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken() == rules{"V6"});
}

TEST_CASE_FIXTURE(traced, "who is lost need not be told that its acceptance "
                          "is late") {
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::request_sent, plan);
  vehicle(trace_step::peer_lost, none);
  vehicle(trace_step::response_got, session);
  pass(1ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "two digests that do not name a session end "
                                   "it, and a copy of the first one does not") {
  vehicle(trace_step::first_data);
  vehicle(trace_step::digest_got, none, {}, 7);
  pass(20ms);
  vehicle(trace_step::digest_got, none, {}, 7);
  pass(480ms);
  CHECK(checker.finish().empty());
  vehicle(trace_step::digest_got, none, {}, 7);
  pass(1ms);
  vehicle(trace_step::offer_got, plan);
  CHECK(broken() == rules{"V8"});
}

TEST_CASE_FIXTURE(running_vehicle, "a digest that is older than a session says "
                                   "nothing of it") {
  vehicle(trace_step::first_data);
  for (int k = 0; k < 3; ++k) {
    pass(500ms);
    vehicle(trace_step::digest_got, none, {}, 6);
  }
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(traced, "a session begins with an acceptance") {
  vehicle(trace_step::begun);
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
    another(trace_step::offer_got, 0);
    x.vehicle(trace_step::offer_got, plan);
    x.vehicle(trace_step::request_sent, plan);
    if (has_data) {
      x.vehicle(trace_step::response_got);
      x.vehicle(trace_step::begun);
      x.vehicle(trace_step::first_data);
    }
    x.pass(d);
    another(trace_step::request_sent, 2);
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
                 .what = trace_step::met,
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
    vehicle(trace_step::forgotten, none);
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
    vehicle(trace_step::forgotten, none);
    CHECK(broken() == rules{"V18"});
  }
}

// -- the provider -------------------------------------------------------------

TEST_CASE_FIXTURE(running_provider, "a provider that tells of what runs, ends "
                                    "it and goes on telling breaks no rule") {
  pass(500ms);
  provider(trace_step::digest_sent);
  pass(200ms);
  provider(trace_step::heard, none, "outside");
  provider(trace_step::closed, first_session, "left_area");
  provider(trace_step::end_sent, first_session, "left_area");
  for (int k = 0; k < 5; ++k) {
    pass(k == 0 ? 300ms : 500ms);
    provider(trace_step::digest_sent, none);
    provider(trace_step::heard, none, "outside");
  }
  pass(2s + 1ns);
  provider(trace_step::forgotten, none, "cam_timeout");
  provider(trace_step::shut_down, none);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_provider, "a digest that does not come is missed") {
  pass(501ms);
  provider(trace_step::heard, none, "inside");
  CHECK(broken() == rules{"P10"});
}

TEST_CASE_FIXTURE(running_provider, "a digest names what runs") {
  pass(500ms);
  provider(trace_step::digest_sent, none);
  CHECK(broken() == rules{"P11"});
}

TEST_CASE_FIXTURE(running_provider, "who is outside loses what runs") {
  provider(trace_step::heard, none, "outside");
  pass(1ms);
  provider(trace_step::heard, none, "outside");
  CHECK(broken().front() == "P8");
}

TEST_CASE_FIXTURE(running_provider, "who is silent for two seconds is "
                                    "forgotten") {
  for (int k = 0; k < 5; ++k) {
    pass(500ms);
    provider(trace_step::digest_sent);
  }
  CHECK(broken() == rules{"P12"});
}

TEST_CASE_FIXTURE(running_provider, "whose requester is lost is forgotten at "
                                    "once") {
  provider(trace_step::peer_lost, none);
  pass(1ms);
  provider(trace_step::heard, none, "inside");
  CHECK(broken() == rules{"P16"});
}

TEST_CASE_FIXTURE(running_provider, "a request is answered once, and a "
                                    "repeated one not at all") {
  provider(trace_step::request_got, plan);
  provider(trace_step::response_sent);
  CHECK(broken() == rules{"P4"});
}

TEST_CASE_FIXTURE(running_provider, "what runs is not offered") {
  pass(1s);
  provider(trace_step::offer_sent, plan);
  CHECK(broken() == rules{"P10", "P3"});
}

TEST_CASE_FIXTURE(running_provider, "nothing runs when a provider has ended in "
                                    "good order") {
  provider(trace_step::shut_down, none);
  CHECK(broken() == rules{"P8"});
}

// -- the selector -------------------------------------------------------------

TEST_CASE_FIXTURE(running_selector, "the own function goes on at once when the "
                                    "last session ends") {
  selector(trace_step::end_got);
  selector(trace_step::unwatched);
  selector(trace_step::source, plan);
  selector(trace_step::used, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_selector, "results come from one source") {
  selector(trace_step::used, plan, 2);
  CHECK(broken() == rules{"S1"});
}

TEST_CASE_FIXTURE(running_selector, "a source that is late is found") {
  selector(trace_step::end_got);
  selector(trace_step::unwatched);
  pass(1ms);
  selector(trace_step::source, plan);
  CHECK(broken() == rules{"S2"});
}

TEST_CASE_FIXTURE(running_selector, "an ended session's result is not used") {
  selector(trace_step::end_got);
  selector(trace_step::unwatched);
  selector(trace_step::source, plan);
  selector(trace_step::used, session, 2);
  CHECK(broken() == rules{"S1", "S4"});
}

TEST_CASE_FIXTURE(running_selector, "results are used in order") {
  selector(trace_step::used, session, 1);
  CHECK(broken() == rules{"S6"});
}

TEST_CASE_FIXTURE(traced, "a remote source that nobody watches is found") {
  selector(trace_step::begun);
  selector(trace_step::first_data);
  selector(trace_step::source);
  selector(trace_step::used);
  CHECK(broken() == rules{"S3"});
}

TEST_CASE("who ends as implausible had its latest result left out, and who "
          "had not ends for a gap") {
  const auto ends = [](const char* reason, bool left_out, bool used_since) {
    running_selector x;
    if (left_out)
      x.selector(trace_step::left_out, session, 2, "useless");
    x.pass(50ms);
    if (used_since)
      x.selector(trace_step::used, session, 3);
    x.pass(100ms);
    x.come_home(reason);
    return x.broken();
  };
  CHECK(ends("implausible", true, false).empty());
  CHECK(ends("qos_gap", false, false).empty());
  CHECK(ends("qos_gap", true, true).empty());
  CHECK(ends("released", true, false).empty());
  CHECK(ends("implausible", false, false) == rules{"S7"});
  CHECK(ends("implausible", true, true) == rules{"S7"});
  CHECK(ends("qos_gap", true, false) == rules{"S7"});
}

TEST_CASE_FIXTURE(running_selector, "what comes in the instant of the end may "
                                    "have come too late for it") {
  selector(trace_step::left_out, session, 2, "useless");
  pass(100ms);
  selector(trace_step::used, session, 3);
  come_home("implausible");
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_selector, "a refused result ends its session at "
                                    "once") {
  selector(trace_step::left_out, session, 2, "refused");
  pass(1ms);
  come_home("implausible");
  CHECK(broken() == rules{"S7"});
}

TEST_CASE_FIXTURE(running_selector, "who does not stand by is not called") {
  selector(trace_step::called);
  CHECK(broken() == rules{"S8"});
}

// -- between the parts --------------------------------------------------------

TEST_CASE_FIXTURE(traced, "what is got has been sent") {
  provider(trace_step::heard, none, "inside");
  provider(trace_step::offer_sent, plan);
  vehicle(trace_step::offer_got, plan);
  vehicle(trace_step::offer_got, plan); // a copy
  CHECK(checker.finish().empty());
  vehicle(trace_step::offer_got, first_session); // of other content
  CHECK(broken() == rules{"M1"});
}

TEST_CASE_FIXTURE(running_vehicle, "of a provider without a trace nothing is "
                                   "missed") {
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "a step that is missing is found") {
  ++last[trace_part::requester];
  vehicle(trace_step::first_data);
  CHECK(broken() == rules{"M2"});
}

TEST_CASE("a selector does what its requester decides, unless it has died") {
  const auto runs = [](bool begins, bool goes_on) {
    running_vehicle x; // has decided
    if (begins)
      x.selector(trace_step::begun, session, 1);
    x.pass(1ms);
    if (goes_on)
      x.selector(trace_step::used, plan);
    return x.broken();
  };
  CHECK(runs(true, true).empty());
  CHECK(runs(false, false).empty());
  CHECK(runs(false, true) == rules{"M3"});
}

TEST_CASE_FIXTURE(traced, "who stands by does so on both sides") {
  selector(trace_step::standby, plan, 20);
  vehicle(trace_step::standby, plan, {}, 20);
  pass(1s);
  vehicle(trace_step::standby, plan, {}, 20);
  CHECK(checker.finish().empty());
  pass(1s);
  selector(trace_step::used, plan);
  CHECK(broken() == rules{"M3"});
}
