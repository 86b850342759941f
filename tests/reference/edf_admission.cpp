// Sessions of 8 ms every 100 ms that leave 20 ms of a latency limit of 50 ms:
// by utilisation 12 fit, released together 2 (16 ≤ 20 < 24), with phases 12
// (100 / 8). Source: arithmetic of Liu & Layland 1973 and Baruah et al. 1990.
#include "policies/algorithms/scheduling/phases.hpp"
#include "policies/algorithms/scheduling/placement.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;

namespace {

// Sessions that a core takes one by one until it rejects.
std::vector<periodic_task> filled(admission_test test) {
  std::vector<std::vector<periodic_task>> cores(1);
  periodic_task session{.wcet = 8ms, .period = 100ms, .deadline = 20ms};
  while (const auto place = worst_fit(cores, session, test)) {
    session.offset = place->offset;
    cores[0].push_back(session);
  }
  return cores[0];
}

} // namespace

TEST_CASE("by utilisation alone a core takes 12 sessions and breaks its word") {
  const auto sessions = filled(admission_test::utilisation);
  CHECK(sessions.size() == 12);
  CHECK(!longest_wait(sessions));
}

TEST_CASE("by demand a core takes 2 sessions that are released together") {
  const auto sessions = filled(admission_test::demand);
  CHECK(sessions.size() == 2);
  CHECK(longest_wait(sessions) == 8ms);
}

TEST_CASE("with assigned phases a core takes 12 sessions, and none waits") {
  const auto sessions = filled(admission_test::phases);
  CHECK(sessions.size() == 12);
  CHECK(longest_wait(sessions) == 0ms);
}
