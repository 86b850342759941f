// Actors that may wait for a program that decides.
#include "actors/runtime/spawn_decider.hpp"

#include "policies/api/context.hpp"
#include "policies/process_policy.hpp"

#include <caf/actor_system_config.hpp>
#include <caf/event_based_actor.hpp>
#include <doctest/doctest.h>

#include <chrono>
#include <future>
#include <memory>

namespace sofof::spawn_decider_test {

namespace {

using namespace std::chrono_literals;
using policy_of_vehicles =
    policies::process_policy<policies::local_context, policies::local_decision,
                             policies::provider_view>;

struct meeting {
  std::promise<void> other_is_there;
  std::promise<bool> have_met;
};

} // namespace

TEST_CASE("who waits for a program keeps nobody else waiting") {
  caf::actor_system_config config;
  config.set("caf.scheduler.max-threads", 1);
  caf::actor_system sys{config};
  policy_of_vehicles policy;
  const auto both = std::make_shared<meeting>();
  const auto waits = [](caf::event_based_actor*,
                        const std::shared_ptr<meeting>& at) {
    at->have_met.set_value(at->other_is_there.get_future().wait_for(5s)
                           == std::future_status::ready);
  };
  actors::spawn_decider(sys, policy, waits, both);
  sys.spawn(
      [both](caf::event_based_actor*) { both->other_is_there.set_value(); });
  CHECK(both->have_met.get_future().get());
}

} // namespace sofof::spawn_decider_test
