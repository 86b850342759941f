// Tests of cabin climate as a service: the cabin asks, the function answers,
// the cabin becomes comfortable.
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"
#include "messages/protocol/bytes.hpp"
#include "tests/support/virtual_world.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct cabin_world : virtual_world {
  service_type_ptr kind = make_service_type("cabin_climate");
  probe<requester_manager_actor> manager = listen<requester_manager_actor>();
  probe<vehicle_actor> vehicle = listen<vehicle_actor>();
  client_actor cabin =
      own(kind->spawn_client({system(), vehicle.handle}).actor);
  std::shared_ptr<offloading::service_function> function =
      kind->in({}).in_vehicle({})->make_function();

  /// What a question says.
  struct climate {
    double air_c = 0, mass_c = 0, outside_c = 0, set_point_c = 0;
  };
  climate last_question() const {
    REQUIRE(manager->count<service_input>() > 0);
    const auto bytes = manager->all<service_input>().back().what.encoded();
    climate c;
    byte_reader in{bytes};
    in(c.air_c, c.mass_c, c.outside_c, c.set_point_c);
    REQUIRE(in.done());
    return c;
  }
  /// Lets the function answer every question for some time.
  void run_service(duration d) {
    for (const auto end = now() + d; now() < end;) {
      run_for(1s);
      const auto question = manager->all<service_input>().back();
      tell(cabin,
           service_result{{}, 1, now(), function->run(now(), question).what});
      manager->clear();
    }
    run_for(1s);
  }
};

} // namespace

TEST_CASE_FIXTURE(cabin_world, "the cabin is its own client, not the vehicle") {
  CHECK(caf::actor_cast<caf::actor>(cabin)
        != caf::actor_cast<caf::actor>(vehicle.handle));
}

TEST_CASE_FIXTURE(cabin_world, "the cabin asks as soon as it knows whom, then "
                               "once a second") {
  run_for(10500ms);
  CHECK(manager->entries().empty());
  tell(cabin, manager.handle);
  CHECK(manager->count<service_input>() == 1);
  manager->clear();
  run_for(10s);
  const auto times = manager->times<service_input>();
  REQUIRE(times.size() == 10);
  for (std::size_t k = 1; k < times.size(); ++k)
    CHECK(times[k] - times[k - 1] == 1s);
}

TEST_CASE_FIXTURE(cabin_world, "without the service it stays cold") {
  tell(cabin, manager.handle);
  run_for(120s);
  const auto c = last_question();
  CHECK(c.set_point_c > c.outside_c + 10);
  CHECK(c.air_c < c.set_point_c - 5);
}

TEST_CASE_FIXTURE(cabin_world, "with the service it becomes comfortable") {
  tell(cabin, manager.handle);
  run_service(600s);
  const auto c = last_question();
  CHECK(std::abs(c.air_c - c.set_point_c) < 1);
}

TEST_CASE_FIXTURE(cabin_world, "changing the source does not disturb it") {
  tell(cabin, manager.handle);
  run_service(600s);
  tell(cabin, source_change{"cabin_climate", true});
  run_service(60s);
  const auto c = last_question();
  CHECK(std::abs(c.air_c - c.set_point_c) < 1);
}

TEST_CASE_FIXTURE(cabin_world, "an answer that is none changes nothing") {
  tell(cabin, manager.handle);
  run_service(600s);
  tell(cabin, service_result{});
  tell(cabin, service_result{{}, 1, now(), payload{}});
  run_for(5s);
  const auto c = last_question();
  CHECK(std::abs(c.air_c - c.set_point_c) < 1);
}

TEST_CASE_FIXTURE(cabin_world, "a cold cabin is heated") {
  tell(cabin, manager.handle);
  run_for(1s);
  const auto cold = manager->all<service_input>().back();
  const auto answer = function->run(now(), cold).what.encoded();
  double power_w = 0;
  byte_reader in{answer};
  in(power_w);
  CHECK(in.done());
  CHECK(power_w > 1000);
}
