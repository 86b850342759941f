// Tests of both sides under messages that no honest peer would send.
#include "offloading/provider_side.hpp"
#include "offloading/vehicle_side.hpp"
#include "policies/registry.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/echo_service.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::policies;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

/// Messages whose parts are drawn from so few values, or from what has been
/// said before, that they often fit to what runs.
class liar {
public:
  std::uint32_t asked = 0; ///< Number of the latest request that was heard.

  explicit liar(std::uint64_t seed) : random_{seed} {}

  std::uint64_t some(std::uint64_t end) {
    return static_cast<std::uint64_t>(
        random_.between(0, static_cast<double>(end)));
  }
  bool often() { return some(4) != 0; }

  offloading::to_vehicle to_vehicle(time_point now) {
    switch (some(4)) {
      case 0:
        return service_offer{some(3), {}, names(), 0, 1, 1ms, time_about(now)};
      case 1: {
        service_response response{some(3), station(), number(), {}};
        if (often())
          response.number = asked;
        for (auto k = some(4); k > 0; --k) {
          response.verdicts.push_back({session(), often(), "why", some(3)});
          said_.push_back(response.verdicts.back().session);
        }
        return response;
      }
      case 2:
        return service_result{known_session(), ++cycle_ - some(3),
                              time_about(now), what()};
      default:
        return service_end{session(), reason(), whose(), what()};
    }
  }

  offloading::to_provider to_provider(time_point now) {
    switch (some(3)) {
      case 0:
        return service_request{some(3), station(), number(), names(), {}, 0};
      case 1:
        return service_input{session(), time_about(now), what(), what(),
                             !often()};
      default:
        return service_end{session(), reason(), whose(), what()};
    }
  }

  cam position(time_point now) {
    return {static_cast<station_id>(station()),
            time_about(now),
            {often() ? 0.0 : 1000.0, 0}};
  }

private:
  station_id station() { return static_cast<station_id>(101 + some(2)); }
  std::uint32_t number() { return static_cast<std::uint32_t>(some(30)); }
  service_name name() {
    constexpr const char* all[] = {"one", "two", "three", ""};
    return all[some(4)];
  }
  std::vector<service_name> names() {
    std::vector<service_name> all(some(4));
    for (auto& x : all)
      x = name();
    return all;
  }
  session_id session() { return {some(3), station(), name(), number()}; }
  session_id known_session() {
    constexpr std::uint64_t latest = 8;
    if (said_.size() < latest || !often())
      return session();
    return said_[said_.size() - 1 - some(latest)];
  }
  time_point time_about(time_point now) {
    return now + from_seconds(random_.between(-0.1, 0.02));
  }
  payload what() { return often() ? payload::of(echo{some(9)}) : payload{}; }
  end_reason reason() { return static_cast<end_reason>(some(12)); }
  side whose() { return some(2) ? side::requester : side::provider; }

  dice random_;
  std::vector<session_id> said_;
  std::uint64_t cycle_ = 3;
};

using timers = std::multimap<time_point, std::uint64_t>;

struct deceived_vehicle final : offloading::vehicle_port {
  timers due;
  std::map<service_name, bool> remote;
  int uses = 0;
  std::uint32_t asked = 0;

  void send(offloading::peer_id, offloading::to_provider message) override {
    if (const auto* request = std::get_if<service_request>(&message))
      asked = request->number;
  }
  void use(const service_result& result) override {
    CHECK(remote[result.session.service] == result.session.is_remote());
    ++uses;
  }
  void on_source(const service_name& service, bool is_remote) override {
    CHECK(std::exchange(remote[service], is_remote) != is_remote);
  }
  void record(sofof::messages::record&&) override {}
  void wake_at(time_point t, std::uint64_t number) override {
    due.emplace(t, number);
  }

  offloading::vehicle_side side{setup(), *this, {}};

  static offloading::vehicle_side_setup setup() {
    offloading::vehicle_side_setup all;
    all.station = 101;
    all.policy = make_lodm("always");
    for (const auto* name : {"one", "two"}) {
      all.services.push_back(in_vehicle(echo_service(name), {}));
    }
    return all;
  }
};

/// Counts the functions that it makes.
struct counting_echo final : offloading::provider_service {
  int& made;
  explicit counting_echo(int& counter) : made{counter} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id) override {
    ++made;
    return std::make_shared<echo_function>();
  }
};

struct deceived_provider final : offloading::provider_side_port {
  timers due;
  int ended = 0, started = 0;

  void send(offloading::peer_id, offloading::to_vehicle) override {}
  offloading::cycle_work finish(const session_id&, time_point start,
                                std::uint64_t) override {
    return start + 2ms;
  }
  void record(sofof::messages::record&& x) override {
    ended += std::holds_alternative<episode_record>(x);
  }
  void wake_at(time_point t, std::uint64_t number) override {
    due.emplace(t, number);
  }

  offloading::provider_side side{setup(), *this};

  offloading::provider_setup setup() {
    offloading::provider_setup all;
    all.id = 1;
    all.area = polygon::regular({0, 0}, 300, 24);
    for (const auto* name : {"one", "two"})
      all.services.push_back(
          {name, echo_options(), std::make_shared<counting_echo>(started)});
    all.policy = make_codm("always");
    return all;
  }
};

/// Runs what is due until then.
template <class Side>
void run_until(time_point end, timers& due, Side& side) {
  while (!due.empty() && due.begin()->first <= end) {
    const auto next = *due.begin();
    due.erase(due.begin());
    side.on_timer(next.second, next.first);
  }
}

} // namespace

TEST_CASE("whatever providers say, a vehicle has one source of each service, "
          "and results") {
  int remote = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    liar lies{seed};
    deceived_vehicle v;
    for (auto t = time_point{}; t < time_point{60s}; t += 10ms) {
      run_until(t, v.due, v.side);
      if (t.time_since_epoch() % 50ms == 0ms)
        for (const auto* name : {"one", "two"})
          v.side.on_input(name, {{}, t, payload::of(echo{1})}, t);
      const offloading::peer_id from{1 + lies.some(2)};
      lies.asked = v.asked;
      v.side.on_message(from, lies.to_vehicle(t), t);
      if (lies.some(500) == 0)
        v.side.on_lost(from, t);
      remote += v.remote["one"];
    }
    CHECK(v.uses > 2000);
    v.side.shut_down(time_point{60s});
    CHECK_FALSE(v.remote["one"]);
    CHECK_FALSE(v.remote["two"]);
  }
  CHECK(remote > 0); // some lies were good ones
}

TEST_CASE("whatever vehicles say, a provider ends each session that it has "
          "started once") {
  int started = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    liar lies{seed};
    deceived_provider p;
    for (auto t = time_point{}; t < time_point{60s}; t += 10ms) {
      run_until(t, p.due, p.side);
      const offloading::peer_id from{1 + lies.some(2)};
      if (lies.some(10) == 0)
        p.side.on_cam(lies.position(t), from, t);
      p.side.on_message(from, lies.to_provider(t), t);
      if (lies.some(500) == 0)
        p.side.on_lost(from, t);
    }
    p.side.shut_down(time_point{60s});
    CHECK(p.ended == p.started);
    started += p.started;
  }
  CHECK(started > 100);
}

TEST_CASE("a peer speaks for no other peer's provider") {
  constexpr offloading::peer_id honest{1}, other{2};
  const session_id session{1, 101, "one", 7};
  const time_point now{1s};
  deceived_vehicle v;
  v.side.on_input("one", {{}, now, payload::of(echo{1})}, now);
  v.side.on_message(honest, service_offer{1, {}, {"one"}, 0, 1, 1ms, now}, now);
  REQUIRE(v.asked == 1);
  const service_response yes{1, 101, 1, {{session, true, ""}}};
  const service_result good{session, 1, now, payload::of(echo{1})};
  v.side.on_message(other, yes, now);
  v.side.on_message(honest, good, now);
  CHECK_FALSE(v.remote["one"]); // there is no session
  v.side.on_message(honest, yes, now);
  v.side.on_message(other, good, now);
  CHECK_FALSE(v.remote["one"]);
  v.side.on_message(honest, good, now);
  CHECK(v.remote["one"]);
  const service_end end{session, end_reason::released, side::provider};
  v.side.on_message(other, end, now);
  CHECK(v.remote["one"]);
  v.side.on_message(honest, end, now);
  CHECK_FALSE(v.remote["one"]);
}
