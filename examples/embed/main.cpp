// A function of one's own, offloaded over a transport of one's own: a car's
// square root is computed by a roadside server while the car is near it. Here
// messages travel through a queue; a real program sends them over its network.
#include "offloading/provider_side.hpp"
#include "offloading/vehicle_side.hpp"
#include "policies/registry.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::offloading;
using namespace sofof::policies;
using namespace std::chrono_literals;

// -- the service: its input and its result are a number -----------------------

struct number {
  double value = 0;
};

void visit_fields(auto& v, number& x) {
  v("value", x.value);
}

template <>
inline constexpr std::string_view sofof::messages::payload_name<number> =
    "number";

struct square_root final : service_function {
  service_output run(time_point, const service_input& input) override {
    const auto x = input.what.as<number>();
    return x ? payload::of(number{std::sqrt(x->value)}) : payload{};
  }
};

struct root_in_car final : vehicle_service {
  std::shared_ptr<service_function> make_function() const override {
    return std::make_shared<square_root>();
  }
};

struct root_at_server final : provider_service {
  std::shared_ptr<service_function> make_function(station_id) override {
    return std::make_shared<square_root>();
  }
};

const service_options options{.limits = {50ms, 100ms, 1s}, // latency, gap, age
                              .period = 50ms,
                              .input_period = 50ms};

// -- the transport: what is sent arrives 8 ms later ---------------------------

struct transport {
  time_point now;
  std::multimap<time_point, std::function<void()>> due;

  void at(time_point t, std::function<void()> what) {
    due.emplace(t, std::move(what));
  }
  void carry(std::function<void()> deliver) { at(now + 8ms, deliver); }

  void run_until(time_point end) {
    while (!due.empty() && due.begin()->first <= end) {
      const auto next = due.extract(due.begin());
      now = next.key();
      next.mapped()();
    }
    now = end;
  }
};

// -- the provider's decision: those in its area -------------------------------

struct those_near final : central_policy {
  std::vector<central_decision>
  decide(const central_context& context) override {
    std::vector<central_decision> all;
    for (const auto& request : context.requests)
      if (!request.route.empty()
          && context.area.contains(request.route.front()))
        all.push_back({accepted{}, "is near"});
      else
        all.push_back({refused{}, "is far away"});
    return all;
  }
  std::string_view name() const override { return "those_near"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<those_near>(*this);
  }
};

// -- both ends ----------------------------------------------------------------

constexpr peer_id car{1}, server{2};

struct roadside final : provider_side_port {
  transport& net;
  std::function<void(const to_vehicle&)> to_car;
  explicit roadside(transport& x) : net{x} {}

  void send(peer_id, to_vehicle message) override {
    net.carry([this, message] { to_car(message); });
  }
  void wake_at(time_point t, std::uint64_t number) override {
    net.at(t, [this, number] { side.on_timer(number, net.now); });
  }

  provider_side side{setup(), *this};

  static provider_setup setup() {
    provider_setup s;
    s.id = 7;
    s.area = polygon::regular({0, 0}, 150, 24); // m
    s.services = {{"root", options, std::make_shared<root_at_server>()}};
    s.policy = std::make_unique<those_near>();
    return s;
  }
};

struct vehicle final : vehicle_port {
  transport& net;
  roadside& near;
  double newest = 0;
  vehicle(transport& x, roadside& y) : net{x}, near{y} {}

  void send(peer_id, to_provider message) override {
    net.carry([this, message] { near.side.on_message(car, message, net.now); });
  }
  void use(const service_result& result) override {
    if (const auto x = result.what.as<number>())
      newest = x->value;
  }
  void on_source(const service_name&, bool remote) override {
    std::printf("%5.2f s: root is computed %s\n", to_seconds(net.now),
                remote ? "by the server" : "in the car");
  }
  void wake_at(time_point t, std::uint64_t number) override {
    net.at(t, [this, number] { side.on_timer(number, net.now); });
  }

  vehicle_side side{setup(), *this, net.now};

  static vehicle_side_setup setup() {
    vehicle_side_setup s;
    s.station = 101;
    s.services = {{"root", options, std::make_shared<root_in_car>()}};
    s.policy = make_lodm("always");
    s.path_ahead = [](const ego_state& ego) { // as far as it is planned
      return std::vector{ego.own.position};
    };
    return s;
  }
};

int main() {
  transport net;
  roadside near{net};
  vehicle own{net, near};
  near.to_car = [&](const to_vehicle& message) {
    own.side.on_message(server, message, net.now);
  };
  for (int tick = 0; tick < 400; ++tick) { // 40 s at 15 m/s
    const cam here{101, net.now, {-300 + 1.5 * tick, 0}, 0, 15};
    own.side.on_motion({here, 1.5 * tick});
    net.carry([&, here] { near.side.on_cam(here, car, net.now); });
    own.side.on_input("root", {{}, net.now, payload::of(number{2.0 + tick})},
                      net.now);
    net.run_until(net.now + 100ms);
  }
  std::printf("the newest root is %.3f\n", own.newest);
}
