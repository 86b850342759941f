// Tests of a provider's side: when a result leaves it.
#include "offloading/provider_side.hpp"

#include "policies/registry.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
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

/// Accepts all, a quarter of a second after the first asked.
struct patient final : central_policy {
  std::vector<central_decision>
  decide(const central_context& context) override {
    return std::vector<central_decision>(context.requests.size(),
                                         {policies::accepted{}, "patience"});
  }
  double epoch_s() const override { return 0.25; }
  std::string_view name() const override { return "patient"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<patient>(*this);
  }
};

/// A provider with such a policy, and when it answered.
struct answering final : offloading::provider_side_port {
  time_point now{1s};
  std::multimap<time_point, std::uint64_t> due;
  std::vector<time_point> answers;
  std::unique_ptr<offloading::provider_side> side;

  answering() {
    offloading::provider_setup setup;
    setup.id = 1;
    setup.area = polygon::regular({0, 0}, 100, 8);
    setup.services.push_back(at_provider(echo_service("one"), {}));
    setup.policy = std::make_unique<patient>();
    side = std::make_unique<offloading::provider_side>(std::move(setup), *this);
  }

  void send(offloading::peer_id, offloading::to_vehicle message) override {
    if (std::holds_alternative<service_response>(message))
      answers.push_back(now);
  }
  time_point finish(const session_id&, time_point start,
                    std::uint64_t) override {
    return start;
  }
  void wake_at(time_point t, std::uint64_t number) override {
    due.emplace(t, number);
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

TEST_CASE("a session is ended by its requester alone") {
  constexpr offloading::peer_id other{8};
  echoing sp{3ms};
  sp.run_until(time_point{2s});
  const auto before = sp.results.size();
  REQUIRE(before > 0);
  const service_end end{
      {1, station, "one", sp.accepted}, end_reason::released, side::requester};
  sp.side->on_message(other, end, sp.now);
  const auto still = sp.results.size();
  for (int k = 0; k < 3; ++k) { // it lives
    sp.side->on_cam({station, sp.now, {0, 0}}, vehicle, sp.now);
    sp.run_until(sp.now + 1s);
  }
  CHECK(sp.results.size() > still);
  sp.side->on_message(vehicle, end, sp.now);
  const auto ended = sp.results.size();
  sp.run_until(sp.now + 1s);
  CHECK(sp.results.size() == ended);
}

TEST_CASE("requests of an epoch are answered together at its end") {
  answering sp;
  for (const station_id asking : {station, station_id{102}}) {
    const offloading::peer_id from{asking.value()};
    sp.side->on_cam({asking, sp.now, {0, 0}}, from, sp.now);
    sp.side->on_message(from, service_request{1, asking, 1, {"one"}, {}, 0},
                        sp.now);
    sp.now += 100ms;
  }
  CHECK(sp.answers.empty());
  while (sp.answers.empty() && !sp.due.empty()) {
    const auto [t, number] = *sp.due.begin();
    sp.due.erase(sp.due.begin());
    sp.now = t;
    sp.side->on_timer(number, t);
  }
  CHECK(sp.answers == std::vector<time_point>(2, time_point{1250ms}));
}
