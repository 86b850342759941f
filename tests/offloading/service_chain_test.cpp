// What the services of a chain take together.
#include "offloading/service_chain.hpp"

#include "tests/support/at.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string_view>
#include <vector>

using namespace sofof;
using namespace sofof::offloading;
using namespace std::chrono_literals;
using test::at;

namespace {

/// Three services that follow each other, listed out of order, and one that is
/// in no chain. At a provider they take 100, 200 and 400 ms, at home 1, 2 and
/// 54 ms.
struct three_and_one {
  std::vector<service_state> all;

  three_and_one() {
    add("last", "middle", 400ms, 4ms, false);
    add("alone", {}, 800ms, 8ms, true);
    add("first", {}, 100ms, 1ms, true);
    add("middle", "first", 200ms, 2ms, true);
  }

  void add(std::string_view name, std::string_view follows, duration away,
           duration run_time, bool per_input) {
    auto own = in_vehicle(test::echo_service(name), {});
    own.follows = messages::service_name{follows};
    own.options.period = 50ms;
    own.options.input_period = 100ms;
    own.options.per_input = per_input;
    own.options.compute.run_time_max = run_time;
    own.options.limits = {50ms, 50ms, away - 50ms - run_time};
    all.emplace_back(own, world::computer_options{}, at(0s));
  }

  service_state& named(std::string_view name) {
    return *std::ranges::find_if(all, [&](const service_state& x) {
      return x.service.name == messages::service_name{name};
    });
  }
  duration worst_with(std::string_view away) {
    const auto& one = named(away);
    return worst_response_of(chain_of(all, one), one);
  }
};

struct looks final : vehicle_service {
  std::shared_ptr<service_function> make_function() const override {
    return nullptr;
  }
  bool looks_at_scenes() const override { return true; }
};

} // namespace

TEST_CASE_FIXTURE(three_and_one, "a chain begins with the service that follows "
                                 "none, whichever of it is asked for") {
  for (const auto* name : {"first", "middle", "last"}) {
    const auto chain = chain_of(all, named(name));
    REQUIRE(chain.size() == 3);
    CHECK(chain[0] == &named("first"));
    CHECK(chain[1] == &named("middle"));
    CHECK(chain[2] == &named("last"));
  }
  CHECK(chain_of(all, named("alone")).size() == 1);
}

TEST_CASE_FIXTURE(three_and_one, "what a chain takes is the sum of its "
                                 "services' times, each where it is, and the "
                                 "one in question at a provider") {
  CHECK(worst_with("first") == 100ms + 2ms + 54ms);
  CHECK(worst_with("last") == 1ms + 2ms + 400ms);
  CHECK(worst_with("alone") == 800ms);
  named("middle").sessions.push_back({.provider = 1}); // asked for already
  CHECK(worst_with("first") == 100ms + 200ms + 54ms);
  CHECK(worst_with("middle") == 1ms + 200ms + 54ms);
  named("last").is_leaving = true; // in the same decision
  CHECK(worst_with("first") == 700ms);
  CHECK(worst_with("alone") == 800ms);
}

TEST_CASE_FIXTURE(three_and_one, "a chain of which one service bounds no age "
                                 "of its inputs has no longest response, once "
                                 "that one is at a provider") {
  named("middle").needs.worst_response = duration::max();
  CHECK(worst_with("first") == 156ms);
  CHECK(worst_with("middle") == duration::max());
  named("middle").is_leaving = true;
  CHECK(worst_with("first") == duration::max());
}

TEST_CASE_FIXTURE(three_and_one, "the scene is as safe as the service says "
                                 "that found it least safe") {
  const auto safe = [this](duration t) {
    return safe_response_of(chain_of(all, named("last")), at(t));
  };
  CHECK_FALSE(safe(0s));
  named("alone").scene = {at(1s), 1ms};
  CHECK_FALSE(safe(1s));
  named("first").scene = {at(1s), 700ms};
  CHECK(safe(1s) == 700ms);
  named("last").scene = {at(1s), 600ms};
  CHECK(safe(1s) == 600ms);
  named("first").scene = {at(2s), 500ms};
  CHECK(safe(2s) == 500ms); // what the last one was told is old
  named("last").scene = {at(3s), 600ms};
  CHECK(safe(3s) == 0ms); // the first one has not looked for a while
}

TEST_CASE_FIXTURE(three_and_one, "before the service that looks at the scene "
                                 "has looked, no response time is safe") {
  named("first").service.own = std::make_shared<looks>();
  const auto chain = chain_of(all, named("last"));
  CHECK(safe_response_of(chain, at(0s)) == 0ms);
  named("first").scene = {at(0s), 700ms};
  CHECK(safe_response_of(chain, at(0s)) == 700ms);
  CHECK_FALSE(safe_response_of(chain_of(all, named("alone")), at(0s)));
}
