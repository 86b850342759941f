// What holds between the parts of the protocol, by their steps.
#include "tests/experiments/written_trace.hpp"

#include <doctest/doctest.h>

namespace sofof::test::traces {

TEST_CASE_FIXTURE(traced, "what is got has been sent") {
  provider(heard, none, "inside");
  provider(offer_sent, plan);
  vehicle(offer_got, plan);
  vehicle(offer_got, plan); // a copy
  CHECK(checker.finish().empty());
  vehicle(offer_got, first_session); // of other content
  CHECK(broken() == rules{"M1"});
}

TEST_CASE_FIXTURE(running_vehicle, "of a provider without a trace nothing is "
                                   "missed") {
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_vehicle, "a step that is missing is found") {
  ++last[trace_part::requester];
  vehicle(first_data);
  CHECK(broken() == rules{"M2"});
}

TEST_CASE("a selector does what its requester decides, unless it has died") {
  const auto runs = [](bool begins, bool goes_on) {
    running_vehicle x; // has decided
    if (begins)
      x.selector(begun, session, 1);
    x.pass(1ms);
    if (goes_on)
      x.selector(used, plan);
    return x.broken();
  };
  CHECK(runs(true, true).empty());
  CHECK(runs(false, false).empty());
  CHECK(runs(false, true) == rules{"M3"});
}

TEST_CASE_FIXTURE(traced, "who stands by does so on both sides") {
  selector(standby, plan, 20);
  vehicle(standby, plan, {}, 20);
  pass(1s);
  vehicle(standby, plan, {}, 20);
  CHECK(checker.finish().empty());
  pass(1s);
  selector(used, plan);
  CHECK(broken() == rules{"M3"});
}

TEST_CASE("a refusal has been sent, unless its provider has never got the "
          "request, as it has started again since") {
  const auto is_refused = [](bool has_got_it) {
    traced x;
    x.provider(heard, none, "inside");
    if (has_got_it)
      x.vehicle(request_sent, plan).provider(request_got, plan);
    x.vehicle(response_got, plan);
    auto all = x.broken();
    std::erase(all, "V3"); // nothing was offered
    return all;
  };
  CHECK(is_refused(false).empty());
  CHECK(is_refused(true) == rules{"M1"});
}
} // namespace sofof::test::traces
