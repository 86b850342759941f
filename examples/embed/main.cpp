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

using namespace sofof;
using namespace std::chrono_literals;

// -- the service: its input and its result are a number -----------------------

struct number {
  double value = 0;
};

void visit_fields(auto& v, number& x) {
  v("value", x.value);
}

template <>
inline constexpr std::string_view sofof::payload_name<number> = "number";

struct square_root final : service_function {
  service_output run(time_point, const service_input& input) override {
    const auto x = input.what.as<number>();
    return x ? payload::of(number{std::sqrt(x->value)}) : payload{};
  }
};

// -- the transport: what is sent arrives 8 ms later ---------------------------

struct network {
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

// -- both ends ----------------------------------------------------------------

constexpr offloading::peer_id car{1}, server{2};

struct roadside final : offloading::provider_side_port {
  network& net;
  std::function<void(const offloading::to_vehicle&)> to_car;
  explicit roadside(network& x) : net{x} {}

  void send(offloading::peer_id, offloading::to_vehicle message) override {
    net.carry([this, message] { to_car(message); });
  }
  offloading::cycle_setup
  make_function(const offloading::session_start&) override {
    offloading::cycle_setup cycle;
    cycle.function = std::make_shared<square_root>();
    cycle.finish = [](time_point start, std::uint64_t) { return start + 2ms; };
    return cycle;
  }
  void record(sofof::record) override {}
  void wake_at(time_point t, std::uint64_t number) override {
    net.at(t, [this, number] { side.on_timer(number, net.now); });
  }

  offloading::provider_side side{setup(), *this};

  static offloading::provider_setup setup() {
    offloading::provider_setup s;
    s.id = 7;
    s.area = polygon::regular({0, 0}, 150, 24); // m
    s.services = {{.name = "root", .period = 50ms, .max_latency = 50ms}};
    s.policy = make_codm("always");
    s.map = std::make_shared<const road_map>();
    return s;
  }
};

struct vehicle final : offloading::vehicle_port {
  network& net;
  roadside& near;
  double newest = 0;
  vehicle(network& x, roadside& y) : net{x}, near{y} {}

  void send(offloading::peer_id, offloading::to_provider message) override {
    net.carry([this, message] { near.side.on_message(car, message, net.now); });
  }
  void use(const service_result& result) override {
    if (const auto x = result.what.as<number>())
      newest = x->value;
  }
  void on_source(const service_name& service, bool remote) override {
    std::printf("%5.2f s: %s is computed %s\n", to_seconds(net.now),
                std::string{service.view()}.c_str(),
                remote ? "by the server" : "in the car");
  }
  void record(sofof::record) override {}
  void wake_at(time_point t, std::uint64_t number) override {
    net.at(t, [this, number] { side.on_timer(number, net.now); });
  }

  offloading::vehicle_side side{setup(), *this, net.now};

  static offloading::vehicle_side_setup setup() {
    offloading::onboard_service root;
    root.requested.name = "root";
    root.requested.needs = {50ms, 50ms, 100ms}; // period, latency, gap
    root.input_period = 50ms;
    root.function = std::make_shared<square_root>();
    offloading::vehicle_side_setup s;
    s.station = 101;
    s.services.push_back(std::move(root));
    s.policy = make_lodm("always");
    return s;
  }
};

int main() {
  network net;
  roadside near{net};
  vehicle own{net, near};
  near.to_car = [&](const offloading::to_vehicle& message) {
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
