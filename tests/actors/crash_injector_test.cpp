// What becomes of an actor whose power is cut.
#include "actors/simulation/crash_injector.hpp"

#include "messages/type_ids.hpp"
#include "tests/support/virtual_world.hpp"

#include <caf/event_based_actor.hpp>
#include <doctest/doctest.h>

#include <memory>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::test;

namespace {

struct fragile_world : virtual_world {
  /// Whether it got a chance to say goodbye, and whether who watches knows.
  std::shared_ptr<bool> said_goodbye = std::make_shared<bool>(false);
  std::shared_ptr<bool> noticed = std::make_shared<bool>(false);
  caf::actor victim = own(system().spawn(
      [goodbye = said_goodbye](caf::event_based_actor* self) -> caf::behavior {
        self->set_exit_handler([=](const caf::exit_msg&) { *goodbye = true; });
        return {[](tick_atom) {}};
      }));
  caf::actor watcher =
      own(system().spawn([this](caf::event_based_actor* self) -> caf::behavior {
        self->monitor(victim);
        self->set_down_handler(
            [seen = noticed](const caf::down_msg&) { *seen = true; });
        return {[](tick_atom) {}};
      }));
};

} // namespace

TEST_CASE_FIXTURE(fragile_world, "when power is cut an actor is gone at once, "
                                 "and says nothing") {
  own(spawn_crash_injector(system(), victim, 5s));
  run_for(4999ms);
  CHECK_FALSE(*noticed);
  run_for(1ms);
  CHECK(*noticed);
  CHECK_FALSE(*said_goodbye);
}

TEST_CASE_FIXTURE(fragile_world, "a cut that is called off never comes") {
  const auto cut = spawn_crash_injector(system(), victim, 5s);
  run_for(1s);
  caf::anon_send_exit(cut, caf::exit_reason::user_shutdown);
  run_for(10s);
  CHECK_FALSE(*noticed);
}
