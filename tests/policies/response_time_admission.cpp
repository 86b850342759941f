// Tests of admission by response times as a policy.
#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::world;
using namespace std::chrono_literals;
using test::is_accepted;

namespace {

/// Planning of 8 ms every 100 ms within 50 ms, of which 30 are the network's.
constexpr periodic_task plan_task{
    .wcet = 8ms, .period = 100ms, .deadline = 50ms};

struct queue_server {
  const polygon area{{{0, 0}, {1, 0}, {1, 1}}};
  const road_map map{"street", {}, {}};
  std::unique_ptr<central_policy> codm = make_codm("response_time");

  queue_server() {
    test::option_list options;
    options.texts = {{"filter.name", "none"}};
    codm->visit_options(options);
    CHECK(options.refused.empty());
  }

  std::vector<central_decision>
  decide(const std::vector<periodic_task>& asked,
         const std::vector<periodic_task>& running = {},
         std::size_t workers = 1) {
    std::vector<request_view> requests;
    for (const auto& task : asked)
      requests.push_back({.station = 101, .service = "any", .at_most = task});
    std::vector<session_view> sessions;
    for (const auto& task : running)
      sessions.push_back({.station = 102, .service = "any", .at_most = task});
    return codm->decide(
        {time_point{}, requests, sessions, 0, workers, area, map});
  }

  std::size_t accepted(std::size_t asked, const periodic_task& task,
                       std::size_t workers = 1) {
    const auto all = decide(std::vector(asked, task), {}, workers);
    return static_cast<std::size_t>(std::ranges::count_if(all, is_accepted));
  }
};

} // namespace

TEST_CASE("sessions are accepted while all could come together in time") {
  CHECK(queue_server{}.accepted(14, plan_task) == 2); // 16 of 20 ms
  CHECK(queue_server{}.accepted(14, plan_task, 3)
        == 5); // (5 · 8 − 8) / 3 + 8 ms
}

TEST_CASE("who is accepted gets a phase, and is told the longest response") {
  const auto all = queue_server{}.decide(std::vector(3, plan_task));
  REQUIRE(all.size() == 3);
  const auto* terms = terms_of(all.front());
  REQUIRE(terms);
  REQUIRE(terms->offset);
  CHECK(*terms->offset >= 0ms);
  CHECK(*terms->offset < 100ms);
  CHECK(all[1].why.text()
        == "every response is in time value_s=0.016 limit_s=0.02");
  CHECK(all[2].why.text()
        == "a response could be late value_s=0.024 limit_s=0.02");
}

TEST_CASE("a session that would make another one late is refused") {
  auto patient = plan_task;
  patient.deadline = 500ms;
  CHECK(is_accepted(queue_server{}.decide({patient}).front()));
  CHECK(is_accepted(queue_server{}.decide({patient}, {plan_task}).front()));
  CHECK(!is_accepted(
      queue_server{}.decide({patient}, {plan_task, plan_task}).front()));
}

TEST_CASE("cycles that do not wait for a phase count twice, called ones three "
          "times") {
  auto slow = plan_task; // its first result would come too late
  slow.period = 1s;
  slow.deadline = 54ms;
  CHECK(queue_server{}.accepted(3, slow) == 1); // 16 of 24 ms
  const auto all = queue_server{}.decide({slow});
  REQUIRE(terms_of(all.front()));
  CHECK(!terms_of(all.front())->offset);
  auto called = plan_task;
  called.jitter = jitter_of_calls(100ms);
  CHECK(queue_server{}.accepted(3, called) == 0); // 24 of 20 ms
  called.deadline = 54ms;
  CHECK(queue_server{}.accepted(3, called) == 1);
}

TEST_CASE("where computing times have no end, few results may be later") {
  auto endless = plan_task;
  endless.overrun = {1e-4, 1e-7};
  CHECK(queue_server{}.accepted(3, endless) == 2);
  endless.overrun = {1e-2, 1e-4};
  const auto all = queue_server{}.decide({endless});
  CHECK(!is_accepted(all.front()));
  CHECK(reason::words_of(all.front().why.text())
        == "too many results could be late");
}

TEST_CASE("what has no bound is refused") {
  auto heavy = plan_task;
  heavy.wcet = 100ms;
  CHECK(queue_server{}.decide({heavy}).front().why
        == "response times would have no bound");
}
