// Tests of the supervisor: it notices when an actor dies.
#include "actors/runtime/supervisor.hpp"

#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct supervised_world : virtual_world {
  probe<road_actor> road = listen<road_actor>();
  probe<recorder_actor> recorder = listen<recorder_actor>();
  std::vector<std::string> lost;
  caf::actor supervisor = own(spawn_supervisor(
      system(), [this](const std::string& what) { lost.push_back(what); }));

  supervised_world() {
    watch(supervisor, caf::actor_cast<caf::actor>(road.handle), "the road");
    watch(supervisor, caf::actor_cast<caf::actor>(recorder.handle),
          "the recorder");
    settle();
  }
};

} // namespace

TEST_CASE_FIXTURE(supervised_world, "the supervisor says who has died") {
  kill(road.handle);
  REQUIRE(lost.size() == 1);
  CHECK(lost.front().find("the road has died") == 0);
}

TEST_CASE_FIXTURE(supervised_world, "actors that are dismissed have not died") {
  caf::anon_send_exit(road.handle, caf::exit_reason::user_shutdown);
  settle();
  CHECK(lost.empty());
}

TEST_CASE_FIXTURE(supervised_world, "it says so of who had died before") {
  const auto late = listen<vehicle_endpoint_actor>();
  kill(late.handle);
  watch(supervisor, caf::actor_cast<caf::actor>(late.handle), "the connection");
  settle();
  REQUIRE(lost.size() == 1);
  CHECK(lost.front().find("the connection has died") == 0);
}

TEST_CASE_FIXTURE(supervised_world,
                  "the supervisor also watches who comes later") {
  const auto late = listen<vehicle_endpoint_actor>();
  watch(supervisor, caf::actor_cast<caf::actor>(late.handle), "the connection");
  settle();
  kill(late.handle);
  REQUIRE(lost.size() == 1);
  CHECK(lost.front().find("the connection has died") == 0);
  kill(road.handle);
  CHECK(lost.size() == 2);
}

TEST_CASE_FIXTURE(supervised_world,
                  "the supervisor outlives those it watches") {
  kill(road.handle);
  kill(recorder.handle);
  CHECK(lost.size() == 2);
}
