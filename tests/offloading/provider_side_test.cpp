// Tests of a provider's side: when results and answers leave it, and whom it
// hears.
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

/// A provider of an echo, whose cycles are computed in the time given.
struct roadside final : offloading::provider_side_port {
  duration computing;
  time_point now{1s};
  std::multimap<time_point, std::uint64_t> due;
  std::vector<time_point> results; ///< When they were sent.
  std::vector<time_point> answers; ///< Likewise, to requests.
  std::uint32_t accepted = 0;      ///< The counter of the latest session.
  std::unique_ptr<offloading::provider_side> side;

  explicit roadside(
      duration x, std::unique_ptr<central_policy> policy = make_codm("always"))
      : computing{x} {
    offloading::provider_setup setup;
    setup.id = 1;
    setup.area = polygon::regular({0, 0}, 100, 8);
    setup.services.push_back(at_provider(echo_service("one"), {}));
    setup.policy = std::move(policy);
    side = std::make_unique<offloading::provider_side>(std::move(setup), *this);
  }

  void hear(station_id who, offloading::peer_id from) {
    side->on_cam({who, now, {0, 0}}, from, now);
  }
  void request(station_id who, offloading::peer_id from) {
    hear(who, from);
    side->on_message(from, service_request{1, who, 1, {"one"}, {}, 0}, now);
  }
  session_id session() const { return {1, station, "one", accepted}; }

  /// The vehicle's session, with its first input.
  void start() {
    request(station, vehicle);
    side->on_message(vehicle,
                     service_input{session(), now, payload::of(echo{1})}, now);
  }

  void send(offloading::peer_id, offloading::to_vehicle message) override {
    if (const auto* response = std::get_if<service_response>(&message)) {
      accepted = response->verdicts.front().session.counter;
      answers.push_back(now);
    }
    if (std::holds_alternative<service_result>(message))
      results.push_back(now);
  }
  offloading::cycle_work finish(const session_id&, time_point start,
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

/// Accepts all, a quarter of a second after the first has asked.
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

} // namespace

TEST_CASE("a result leaves a provider when its cycle is done") {
  roadside slow{3ms};
  slow.start();
  CHECK(slow.accepted != 0);
  CHECK(slow.results.empty());
  slow.run_until(time_point{1s + 3ms});
  CHECK(slow.results == std::vector{time_point{1s + 3ms}});
}

TEST_CASE("a result that is computed in no time leaves a provider at once") {
  roadside fast{0ms};
  fast.start();
  CHECK(fast.accepted != 0);
  CHECK(fast.results == std::vector{time_point{1s}});
}

TEST_CASE("a session is ended by its requester alone") {
  roadside sp{3ms};
  sp.start();
  const service_end end{sp.session(), end_reason::released, side::requester};
  sp.run_until(time_point{2s});
  sp.hear(station, vehicle); // it lives
  sp.side->on_message(offloading::peer_id{8}, end, sp.now);
  const auto before = sp.results.size();
  sp.run_until(time_point{3s});
  CHECK(sp.results.size() > before);
  sp.hear(station, vehicle);
  sp.side->on_message(vehicle, end, sp.now);
  const auto ended = sp.results.size();
  sp.run_until(time_point{4s});
  CHECK(sp.results.size() == ended);
}

TEST_CASE("a station lives by its CAMs") {
  for (const auto again : {true, false}) {
    CAPTURE(again);
    roadside sp{3ms};
    sp.start();
    sp.run_until(time_point{2s});
    if (again)
      sp.hear(station, vehicle);
    sp.run_until(time_point{3500ms}); // 2.5 s after the CAM before
    const auto before = sp.results.size();
    sp.run_until(time_point{3900ms});
    CHECK((sp.results.size() > before) == again);
  }
}

TEST_CASE("requests of an epoch are answered together at its end") {
  roadside sp{3ms, std::make_unique<patient>()};
  sp.request(station, vehicle);
  sp.run_until(time_point{1100ms});
  sp.request(station_id{102}, offloading::peer_id{8});
  sp.run_until(time_point{1250ms - 1ns});
  CHECK(sp.answers.empty());
  sp.run_until(time_point{1250ms});
  CHECK(sp.answers == std::vector<time_point>(2, time_point{1250ms}));
}
