// Tests of admission by deadlines as a policy.
#include "policies/registry.hpp"
#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::world;
using namespace std::chrono_literals;
using test::is_accepted;

namespace {

/// Planning of 8 ms every 100 ms within 50 ms, of which 30 are the network's.
constexpr periodic_task planning{
    .wcet = 8ms, .period = 100ms, .deadline = 50ms};

struct server {
  const polygon area{{{0, 0}, {1, 0}, {1, 1}}};
  const road_map map{"street", {}, {}};
  std::unique_ptr<central_policy> codm = make_codm("edf");

  explicit server(const std::string& test = "phases", double margin = 0) {
    test::option_list options;
    options.texts = {{"test", test}, {"filter.name", "none"}};
    options.numbers = {{"margin", margin}};
    codm->visit_options(options);
    CHECK(options.refused.empty());
  }

  server clone() const {
    server other;
    other.codm = codm->clone();
    return other;
  }

  std::vector<central_decision>
  decide(std::size_t requests, const std::vector<session_view>& sessions = {},
         std::size_t workers = 1) {
    const std::vector<request_view> all(requests,
                                        {101, "any", {}, 10, 0.08, planning});
    return codm->decide({time_point{}, all, sessions, 0, workers, area, map});
  }

  static std::size_t accepted(const std::vector<central_decision>& all) {
    return static_cast<std::size_t>(std::ranges::count_if(all, is_accepted));
  }
};

/// One that runs, on a worker and with an offset.
session_view running(std::size_t worker, duration offset) {
  auto task = planning;
  task.offset = offset;
  return {102, "any", {}, task, worker};
}

} // namespace

TEST_CASE("a worker takes twelve by utilisation, two by demand, twelve with "
          "phases") {
  CHECK(server::accepted(server{"utilisation"}.decide(14)) == 12);
  CHECK(server::accepted(server{"demand"}.decide(14)) == 2);
  CHECK(server::accepted(server{"phases"}.decide(14)) == 12);
}

TEST_CASE("three workers take three times as many, spread evenly") {
  const auto all = server{"phases"}.decide(40, {}, 3);
  CHECK(server::accepted(all) == 36);
  std::vector<int> on(3);
  for (const auto& decision : all)
    if (const auto* terms = terms_of(decision))
      ++on.at(terms->worker);
  CHECK(on == std::vector{12, 12, 12});
}

TEST_CASE("who is accepted does not compute while another one does") {
  const auto decision = server{}.decide(1, {running(0, 0ms)}).front();
  REQUIRE(is_accepted(decision));
  const auto offset = terms_of(decision)->offset.value();
  CHECK(offset >= 8ms);
  CHECK(offset <= 92ms);
}

TEST_CASE("what runs counts, on the worker where it runs") {
  const std::vector<session_view> two{running(0, 0ms), running(0, 8ms)};
  CHECK(server::accepted(server{"demand"}.decide(1, two)) == 0);
  const auto beside = server{"demand"}.decide(1, two, 2).front();
  REQUIRE(is_accepted(beside));
  CHECK(terms_of(beside)->worker == 1);
}

TEST_CASE("a session on a worker that is not there counts on the last one") {
  CHECK(server::accepted(
            server{"demand"}.decide(1, {running(7, 0ms), running(9, 0ms)}))
        == 0);
}

TEST_CASE("without phases nobody is told when to compute") {
  for (const auto& decision : server{"demand"}.decide(2))
    CHECK((!is_accepted(decision) || !terms_of(decision)->offset));
}

TEST_CASE("who would wait too long for its first phase is refused") {
  server at{"phases"};
  auto slow = planning;
  slow.period = 1s;
  const std::vector<request_view> one{{101, "any", {}, 10, 0.01, slow}};
  const auto decided =
      at.codm->decide({time_point{}, one, {}, 0, 1, at.area, at.map});
  CHECK(!is_accepted(decided.front()));
  CHECK(decided.front().why == "its first result would come too late");
  CHECK(decided.front().why.text().find(" limit_s=1") != std::string::npos);
}

TEST_CASE("a margin is added to computing times") {
  CHECK(server::accepted(server{"utilisation", 0.1}.decide(14)) == 11);
}

TEST_CASE("an unknown test is refused, and a clone keeps the known one") {
  test::option_list options;
  options.texts = {{"test", "utilization"}};
  make_codm("edf")->visit_options(options);
  CHECK(options.refused.contains("test"));
  CHECK(server::accepted(server{"demand"}.clone().decide(14)) == 2);
}
