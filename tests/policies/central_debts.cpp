// Tests of drift_plus_penalty at a provider: whose results are late, and who
// pays for it.
#include "tests/policies/scene.hpp"

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

episode_outcome late_after(double remote_s) {
  return {"any", self, remote_s, "qos_latency", 101};
}

} // namespace

TEST_CASE("without debts drift-plus-penalty decides as assignment does") {
  dice random{7};
  for (int k = 0; k < 50; ++k) {
    scene at;
    fill(at, random, 8);
    CHECK(at.verdicts("drift_plus_penalty") == at.verdicts("assignment"));
  }
}

TEST_CASE("who is late too often is refused until its debt is paid") {
  scene at;
  at.ask(0.08, {{self, 0.5, 0}});
  const auto codm = codm_of("drift_plus_penalty");
  int lates = 0;
  while (at.verdicts(*codm) == "h") {
    REQUIRE(++lates < 20);
    codm->observe(late_after(0.5));
  }
  CHECK(lates > 1); // one is no reason
  CHECK(at.decide(*codm).front().why == "late too often");
  scene other;
  other.ask(0.08, {{self, 0.5, 0}});
  other.requests.front().station = 103;
  CHECK(other.verdicts(*codm) == "h"); // nobody pays for another one
  auto waited = 0s;
  while (at.verdicts(*codm) == "-") {
    REQUIRE(++waited < 300s);
    at.now += 1s;
  }
  CHECK(waited > 1s);
}

TEST_CASE("who is late seldom enough is never refused") {
  scene at;
  at.ask(0.08, {{self, 0.5, 0}});
  const auto codm = codm_of("drift_plus_penalty");
  for (int k = 0; k < 1000; ++k) {
    CHECK(at.verdicts(*codm) == "h");
    codm->observe(late_after(20)); // 200 cycles, of which 2 may be
    at.now += 20s;
  }
}
