// What holds between the services of a chain, by the steps of their selectors.
#include "experiments/conformance/trace_file.hpp"
#include "tests/experiments/written_trace.hpp"

#include <doctest/doctest.h>

#include <initializer_list>

namespace sofof::test::traces {

namespace {

/// A vehicle in which the service "plan" follows "look".
struct chained {
  trace_checker checker{duration{0}, {{"plan", "look"}}};
  time_point now{1s};
  std::map<service_name, std::uint64_t> last; // steps; "" of the requester

  void pass(duration d) { now += d; }

  void add(trace_part by, trace_step what, const traced_service& of,
           std::string detail) {
    const auto& part = by == trace_part::selector ? of.name : service_name{};
    checker.add({.at = now,
                 .by = by,
                 .step = ++last[part],
                 .what = what,
                 .provider = of.counter == 0 ? provider_id{0} : server,
                 .station = car,
                 .number = last[part],
                 .services = {of},
                 .detail = std::move(detail)},
                {0, checker.steps() + 1});
  }
  void selector(const char* service, std::initializer_list<trace_step> steps) {
    for (const auto what : steps)
      add(trace_part::selector, what, {service, 0}, {});
  }
  /// One look, and the plan that is made of it.
  void cycle() {
    selector("look", {asked});
    pass(2ms);
    selector("look", {used});
    selector("plan", {asked});
    pass(10ms);
    selector("plan", {used});
    pass(38ms);
  }

  /// @returns of the broken rules those of chains.
  std::vector<std::string> broken() {
    std::vector<std::string> all;
    for (const auto& x : checker.finish())
      if (x.broken.id.starts_with("C"))
        all.push_back(std::string{x.broken.id});
    return all;
  }
};

} // namespace

TEST_CASE_FIXTURE(chained, "a chain that makes an input of each result keeps "
                           "the rules") {
  cycle();
  cycle();
  selector("look", {asked, used}); // at the end of the run
  CHECK(broken().empty());
}

TEST_CASE_FIXTURE(chained, "an input that no result was made of is found") {
  cycle();
  selector("plan", {asked});
  cycle();
  CHECK(broken() == rules{"C1"});
}

TEST_CASE_FIXTURE(chained, "an input that comes later than its result is "
                           "found") {
  cycle();
  selector("look", {asked, used});
  pass(1ms);
  selector("plan", {asked, used});
  CHECK(broken() == rules{"C2", "C1"});
}

TEST_CASE_FIXTURE(chained, "two inputs of one result are found") {
  cycle();
  selector("look", {asked, used});
  selector("plan", {asked, asked});
  CHECK(broken() == rules{"C1"});
}

TEST_CASE_FIXTURE(chained, "a result that no input was made of is found, "
                           "unless the vehicle has died") {
  cycle();
  selector("look", {used});
  SUBCASE("it has not") {
    cycle();
    CHECK(broken() == rules{"C2"});
  }
  SUBCASE("it has") {
    CHECK(broken().empty());
  }
}

TEST_CASE_FIXTURE(chained, "a plan that was made of nothing is found") {
  selector("look", {asked});
  selector("plan", {used});
  CHECK(broken() == rules{"C3"});
}

TEST_CASE_FIXTURE(chained, "a service that follows none that is there is no "
                           "part of a chain") {
  selector("plan", {asked, used});
  pass(1ms);
  selector("plan", {asked, used});
  CHECK(broken().empty());
}

TEST_CASE("a fallback of one service leaves the others where they are") {
  const auto ends = [](const char* look_as, const char* plan_as,
                       duration later) {
    chained x;
    x.add(trace_part::requester, closed, {"look", 7}, look_as);
    x.pass(later);
    x.add(trace_part::requester, closed, {"plan", 8}, plan_as);
    return x.broken();
  };
  CHECK(ends("qos_gap", "released", 0ms) == rules{"C4"});
  CHECK(ends("released", "implausible", 0ms) == rules{"C4"});
  CHECK(ends("qos_gap", "released", 1ms).empty());
  CHECK(ends("qos_gap", "qos_latency", 0ms).empty()); // each for its own
  CHECK(ends("released", "released", 0ms).empty());
  CHECK(ends("peer_lost", "peer_lost", 0ms).empty());
}

TEST_CASE_FIXTURE(chained,
                  "who stands by for a service is let go when that one "
                  "is late, though another is late at that moment") {
  add(trace_part::requester, closed, {"look", 6}, "released");
  add(trace_part::requester, closed, {"look", 7}, "qos_gap");
  add(trace_part::requester, closed, {"plan", 8}, "released");
  SUBCASE("it is") {
    add(trace_part::requester, closed, {"plan", 9}, "qos_gap");
    CHECK(broken().empty());
  }
  SUBCASE("it is not") {
    CHECK(broken() == rules{"C4"});
  }
}

TEST_CASE_FIXTURE(running_vehicle, "a session that closes as another service "
                                   "of its vehicle is late is found") {
  vehicle(first_data);
  vehicle(violation, {{"look", 6}});
  vehicle(closed, session, "qos_gap");
  vehicle(end_sent, session, "qos_gap");
  CHECK(broken() == rules{"V20"});
}

TEST_CASE("tracks make scenes, and scenes make plans") {
  const auto chain = chain_of_services();
  CHECK(chain.at("environment_model") == "tracking");
  CHECK(chain.at("trajectory_planning") == "environment_model");
  CHECK(chain.size() == 2);
}
} // namespace sofof::test::traces
