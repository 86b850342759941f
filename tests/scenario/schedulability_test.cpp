// Tests of what is stated of response times before a run.
#include "scenario/schedulability.hpp"

#include "tests/scenario/example.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

/// Six of the eight vehicles are connected; the second provider offers heating
/// alone.
provider_schedule schedule(std::size_t place,
                           const std::vector<std::string>& set = {}) {
  return schedule_of(example::load(example::text, set), place);
}

std::string warning(const std::vector<std::string>& set) {
  const auto all = example::load(example::text, set);
  return warning_of(schedule_of(all, 0), all);
}

const std::vector<std::string> two_ms{"compute.model=ideal",
                                      "compute.more_computing=2ms"};
const auto heating_ms = 2 * 200.0 / 5500; // by its run time on board

} // namespace

TEST_CASE("each connected vehicle counts, with all that the provider offers") {
  const auto both = schedule(0, two_ms);
  CHECK(both.provider == "mec");
  CHECK(both.vehicles == 6);
  CHECK(both.load == doctest::Approx(6 * (2.0 / 50 + heating_ms / 1000)));
  REQUIRE(both.services.size() == 2);
  for (const auto& one : both.services) {
    CHECK(one.is_in_time());
    CHECK(to_milliseconds(one.running.value().at_most)
          == doctest::Approx(6 * (2 + heating_ms)));
    CHECK(to_milliseconds(one.beginning.value().at_most)
          == doctest::Approx(12 * (2 + heating_ms)));
  }
  CHECK(both.in_time_with == 6);
  CHECK(warning(two_ms).empty());
  const auto heating = schedule(1, two_ms);
  REQUIRE(heating.services.size() == 1);
  CHECK(heating.services.front().service == "cabin_climate");
}

TEST_CASE("a provider that may be too slow is told, and with how many vehicles "
          "it is not") {
  // 13.5 ms in 50 at most, in six cars; two of them might ask for four at once.
  const auto busy = schedule(0);
  CHECK(busy.in_time_with == 1);
  CHECK(!busy.services.front().beginning);
  CHECK(warning({})
        == "provider \"mec\" may be too slow, with 6 vehicles at once: a "
           "response of \"trajectory_planning\" has no bound, where 50.0 "
           "ms are allowed; with up to 1 all are in time, or with 5 workers.");
  CHECK(warning({"policies.codm=response_time"}).empty());
}

TEST_CASE("of providers that are alike only one is told of, and how many are "
          "like it") {
  auto one = schedule(0);
  auto other = one;
  other.provider = "another";
  CHECK(one.is_like(other));
  CHECK(!one.is_like(schedule(1)));
  other.in_time_with = 2;
  CHECK(!one.is_like(other));
  one.alike = 3;
  CHECK(to_comment(one).find("\"mec\" and 3 like it (") != std::string::npos);
  CHECK(warning_of(one, example::load())
            .find("\"mec\", like 3 more, may be too slow")
        != std::string::npos);
}

TEST_CASE("with one vehicle less than is in time it is in time, with one more "
          "it is not") {
  const auto set = [](int vehicles) {
    return std::vector<std::string>{
        "compute.model=ideal", "compute.more_computing=4ms",
        "fleet.0.count=" + std::to_string(vehicles)};
  };
  const auto most = schedule(0, set(12)).in_time_with;
  CHECK(most == 6); // 12 · 4.15 ms
  CHECK(!warning(set(7)).empty());
  CHECK(warning(set(6)).empty());
}

TEST_CASE("with one worker less than are needed some are late") {
  const auto with = [](std::int64_t workers) {
    return schedule(0, {"fleet.0.count=60", "compute.model=ideal",
                        "compute.more_computing=4ms",
                        "compute.workers=" + std::to_string(workers)});
  };
  const auto needed = with(1).workers_needed.value();
  CHECK(needed > 5); // 60 times 4 ms in 50
  CHECK(with(needed).in_time_with == 60);
  CHECK(with(needed - 1).in_time_with < 60);
  CHECK(with(needed).workers_needed == needed);
}

TEST_CASE("where a single result is late no number of workers helps") {
  const auto slow =
      schedule(0, {"compute.model=ideal", "compute.more_computing=60ms"});
  CHECK(!slow.workers_needed);
  CHECK(to_comment(slow).find("all in time with no number of workers")
        != std::string::npos);
}

TEST_CASE("where computing times have no end, a quantile is stated") {
  const std::vector<std::string> endless{"compute.model=paper_5g"};
  const auto text = to_comment(schedule(0, endless));
  CHECK(text.find(" ms for all but ") != text.npos);
  CHECK(text.starts_with(
      "# Provider \"mec\" (2 workers), vehicles at once: 6; load "));
  for (const auto& one : schedule(0, endless).services) {
    CHECK(one.running.value().later > 0);
    CHECK(one.running.value().later < 0.01);
  }
}
