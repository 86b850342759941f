// Tests of the life of a service instance.
#include "messages/protocol/lifecycle.hpp"

#include <doctest/doctest.h>

#include <map>
#include <utility>

using namespace sofof;
using namespace sofof::messages;

TEST_CASE("a life goes unconfigured, inactive, active, finalized, and no "
          "other way") {
  using enum lifecycle_state;
  using enum lifecycle_step;
  const std::map<std::pair<lifecycle_state, lifecycle_step>, lifecycle_state>
      possible{
          {{unconfigured, configure}, inactive},
          {{inactive, activate}, active},
          {{active, deactivate}, inactive},
          {{unconfigured, shut_down}, finalized},
          {{inactive, shut_down}, finalized},
          {{active, shut_down}, finalized},
      };
  for (const auto from : {unconfigured, inactive, active, finalized})
    for (const auto step : {configure, activate, deactivate, shut_down}) {
      CAPTURE(name_of(from));
      CAPTURE(static_cast<int>(step));
      const auto i = possible.find({from, step});
      const auto next = after(from, step);
      CHECK(next.has_value() == (i != possible.end()));
      if (next)
        CHECK(*next == i->second);
    }
}

TEST_CASE("states have the names of ROS 2 lifecycle nodes") {
  CHECK(name_of(lifecycle_state::unconfigured) == "unconfigured");
  CHECK(name_of(lifecycle_state::inactive) == "inactive");
  CHECK(name_of(lifecycle_state::active) == "active");
  CHECK(name_of(lifecycle_state::finalized) == "finalized");
}
