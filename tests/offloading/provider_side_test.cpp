// Tests of a provider's side: when a result leaves it.
#include "offloading/provider_side.hpp"

#include "policies/registry.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <variant>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

constexpr offloading::peer_id vehicle{7};
constexpr station_id station = 101;

/// A provider that runs an echo for one vehicle from time 1 s on, whose cycles
/// are computed in the time given.
struct echoing final : offloading::provider_side_port {
  duration computing;
  time_point now{1s};
  std::multimap<time_point, std::uint64_t> due;
  std::vector<time_point> results; ///< When they were sent.
  std::uint32_t accepted = 0;      ///< The counter of the session.
  std::unique_ptr<offloading::provider_side> side;

  explicit echoing(duration x) : computing{x} {
    offloading::provider_setup setup;
    setup.id = 1;
    setup.area = polygon::regular({0, 0}, 100, 8);
    setup.services.push_back(at_provider(echo_service("one"), {}));
    setup.policy = make_codm("always");
    side = std::make_unique<offloading::provider_side>(std::move(setup), *this);
    side->on_cam({station, now, {0, 0}}, vehicle, now);
    side->on_message(vehicle, service_request{1, station, 1, {"one"}, {}, 0},
                     now);
    side->on_message(
        vehicle,
        service_input{{1, station, "one", accepted}, now, payload::of(echo{1})},
        now);
  }

  void send(offloading::peer_id, offloading::to_vehicle message) override {
    if (const auto* response = std::get_if<service_response>(&message))
      accepted = response->verdicts.front().session.counter;
    if (std::holds_alternative<service_result>(message))
      results.push_back(now);
  }
  time_point finish(const session_id&, time_point start,
                    std::uint64_t) override {
    return start + computing;
  }
  void wake_at(time_point t, std::uint64_t number) override {
    due.emplace(t, number);
  }

  void run_until(time_point end) {
    while (!due.empty() && due.begin()->first <= end) {
      const auto [t, number] = *due.begin();
      due.erase(due.begin());
      now = t;
      side->on_timer(number, now);
    }
    now = end;
  }
};

} // namespace

TEST_CASE("a result leaves a provider when its cycle is done") {
  echoing slow{3ms};
  CHECK(slow.accepted != 0);
  CHECK(slow.results.empty());
  slow.run_until(time_point{1s + 3ms});
  CHECK(slow.results == std::vector{time_point{1s + 3ms}});
}

TEST_CASE("a result that is computed in no time leaves a provider at once") {
  const echoing fast{0ms};
  CHECK(fast.accepted != 0);
  CHECK(fast.results == std::vector{time_point{1s}});
}
