// What a source selector may do, by its steps.
#include "tests/experiments/written_trace.hpp"

#include <doctest/doctest.h>

namespace sofof::test::traces {

TEST_CASE_FIXTURE(running_selector, "the own function goes on at once when the "
                                    "last session ends") {
  selector(end_got);
  selector(unwatched);
  selector(source, plan);
  selector(used, plan);
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_selector, "results come from one source") {
  selector(used, plan, 2);
  CHECK(broken() == rules{"S1"});
}

TEST_CASE_FIXTURE(running_selector, "a source that is late is found") {
  selector(end_got);
  selector(unwatched);
  pass(1ms);
  selector(source, plan);
  CHECK(broken() == rules{"S2"});
}

TEST_CASE_FIXTURE(running_selector, "an ended session's result is not used") {
  selector(end_got);
  selector(unwatched);
  selector(source, plan);
  selector(used, session, 2);
  CHECK(broken() == rules{"S1", "S4"});
}

TEST_CASE_FIXTURE(running_selector, "results are used in order") {
  selector(used, session, 1);
  CHECK(broken() == rules{"S6"});
}

TEST_CASE_FIXTURE(traced, "a remote source that nobody watches is found") {
  selector(begun);
  selector(first_data);
  selector(source);
  selector(used);
  CHECK(broken() == rules{"S3"});
}

TEST_CASE("who ends as implausible had its latest result left out, and who "
          "had not ends for a gap") {
  const auto ends = [](const char* reason, bool was_left_out, bool used_since) {
    running_selector x;
    if (was_left_out)
      x.selector(left_out, session, 2, "useless");
    x.pass(50ms);
    if (used_since)
      x.selector(used, session, 3);
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
  selector(left_out, session, 2, "useless");
  pass(100ms);
  selector(used, session, 3);
  come_home("implausible");
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(running_selector, "a refused result ends its session at "
                                    "once") {
  selector(left_out, session, 2, "refused");
  pass(1ms);
  come_home("implausible");
  CHECK(broken() == rules{"S7"});
}

TEST_CASE_FIXTURE(running_selector, "who does not stand by is not called") {
  selector(called);
  CHECK(broken() == rules{"S8"});
}

TEST_CASE_FIXTURE(running_selector, "a session begins once") {
  selector(begun);
  CHECK(broken() == rules{"S5"});
}
} // namespace sofof::test::traces
