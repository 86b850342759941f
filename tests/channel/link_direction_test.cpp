// One direction of a link: delay, airtime, loss, stalls and order.
#include "channel/link_direction.hpp"

#include "channel/provider_compute.hpp"
#include "tests/channel/cycles.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using test::cycle;
using test::near;
using namespace std::chrono_literals;

namespace {

using kind = message_class;

const random_stream link_seed{1, "link"};

channel_draws link_channel(const channel_profile& profile,
                           station_id station = 1, std::uint32_t provider = 0) {
  return {std::make_shared<channel_profile>(profile), link_seed, station,
          provider};
}

channel_profile named(std::string_view name) {
  return *find_channel_profile(name);
}

channel_profile measured() {
  auto p = named("trace");
  p.trace = {{0, 0.020}, {1, 0.030}, {2, 0.250}};
  p.scatters_trace = false;
  return p;
}

// Arrivals of results 0, 1, 2, ... at 20 Hz.
std::vector<std::optional<time_point>> results(link_direction link,
                                               std::uint64_t count) {
  std::vector<std::optional<time_point>> arrivals;
  for (std::uint64_t n = 0; n < count; ++n)
    arrivals.push_back(link.arrival(cycle(n), kind::result, n));
  return arrivals;
}

double share_lost(const channel_profile& p, std::uint64_t count) {
  double lost = 0;
  for (const auto& t :
       results({link_channel(p), direction::down, nullptr}, count))
    lost += !t;
  return lost / static_cast<double>(count);
}

} // namespace

TEST_CASE("an ideal link takes no time") {
  link_direction link{link_channel(named("ideal")), direction::up, nullptr};
  CHECK(link.arrival(time_point{3ms}, kind::other, 0) == time_point{3ms});
  CHECK(link.arrival(time_point{3ms}, kind::result, 7) == time_point{3ms});
}

TEST_CASE("no message overtakes another") {
  auto p = named("paper_5g");
  p.network = delay_distribution::uniform(0ms, 200ms);
  for (const auto direction : {direction::up, direction::down}) {
    link_direction link{link_channel(p), direction, nullptr};
    auto last = time_point{};
    for (std::uint64_t n = 0; n < 2000; ++n) {
      const auto sent = time_point{n * 10ms};
      const auto t = link.arrival(sent, n % 3 ? kind::result : kind::other, n);
      REQUIRE(t >= last);
      REQUIRE(t >= sent);
      last = *t;
    }
  }
}

TEST_CASE("a digest waits for no message, and none waits for it") {
  auto p = named("paper_5g");
  p.network = delay_distribution::uniform(0ms, 200ms);
  link_direction quiet{link_channel(p), direction::down, nullptr};
  link_direction busy{link_channel(p), direction::down, nullptr};
  int overtakes = 0, is_overtaken = 0;
  auto last = time_point{};
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const auto sent = time_point{n * 10ms};
    const auto digest = *busy.arrival(sent, kind::digest, n);
    const auto result = *busy.arrival(sent, kind::result, n);
    REQUIRE(result == quiet.arrival(sent, kind::result, n));
    REQUIRE(digest >= sent);
    REQUIRE(digest <= sent + 300ms);
    overtakes += digest < last;
    is_overtaken += digest > result;
    last = result;
  }
  CHECK(overtakes > 500);
  CHECK(is_overtaken > 100);
}

TEST_CASE("other messages do not shift the noise of results") {
  const auto p = named("paper_sim");
  link_direction quiet{link_channel(p), direction::down, nullptr};
  link_direction busy{link_channel(p), direction::down, nullptr};
  std::uint64_t others = 0;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    // Early enough not to hold the result up: the delay is below 31.5 ms.
    for (std::uint64_t i = 0; n > 0 && i < n % 3; ++i)
      busy.arrival(cycle(n) - 32ms, kind::other, others++);
    const auto undisturbed =
        cycle(n) + link_channel(p).downlink_delay(n, cycle(n));
    CHECK(quiet.arrival(cycle(n), kind::result, n) == undisturbed);
    CHECK(busy.arrival(cycle(n), kind::result, n) == undisturbed);
  }
}

TEST_CASE("results that are not sent do not shift those that are") {
  const auto all = results(
      {link_channel(named("cicv5g_n78")), direction::down, nullptr}, 20'000);
  link_direction half{link_channel(named("cicv5g_n78")), direction::down,
                      nullptr};
  auto same = 0;
  for (std::uint64_t n = 0; n < all.size(); n += 2)
    same += half.arrival(cycle(n), kind::result, n) == all[n];
  CHECK(same == 10'000);
}

TEST_CASE("vehicles, providers, directions and classes draw for themselves") {
  const auto p = named("cicv5g_n8");
  const auto delay = [&](station_id s, std::uint32_t provider, direction w,
                         kind k) {
    return link_channel(p, s, provider).network_delay({w, k, 5}, cycle(5));
  };
  const auto one = delay(1, 0, direction::down, kind::result);
  CHECK(one == delay(1, 0, direction::down, kind::result));
  CHECK(one != delay(2, 0, direction::down, kind::result));
  CHECK(one != delay(1, 1, direction::down, kind::result));
  CHECK(one != delay(1, 0, direction::up, kind::result));
  CHECK(one != delay(1, 0, direction::down, kind::other));
}

TEST_CASE("what is sent in a stall arrives together after its end") {
  auto p = named("cicv5g_n78");
  p.stalls.rate_hz = 0.1;
  const auto link = link_channel(p);
  auto stalls = link.stalls();
  const auto arrivals = results({link, direction::down, nullptr}, 20'000);
  auto held = 0;
  for (std::uint64_t n = 1; n < arrivals.size(); ++n) {
    const auto stall = stalls.at(cycle(n));
    if (!stall)
      continue;
    ++held;
    const auto released =
        stall->end + link.burst_delay(direction::down, stall->number);
    // Later when something from before the stall is still under way.
    CHECK(*arrivals[n] >= released);
    if (cycle(n + 1) < stall->end)
      CHECK(arrivals[n] == arrivals[n + 1]);
  }
  CHECK(held > 300);
}

TEST_CASE("a stall holds up both directions and all providers of a vehicle") {
  const auto p = named("cicv5g_n78");
  auto one = link_channel(p, 1, 0).stalls();
  auto other_provider = link_channel(p, 1, 1).stalls();
  auto other_vehicle = link_channel(p, 2, 0).stalls();
  auto apart = 0;
  for (auto t = time_point{}; t < time_point{1000s}; t += 50ms) {
    const auto stalled = one.at(t).has_value();
    CHECK(stalled == other_provider.at(t).has_value());
    apart += stalled != other_vehicle.at(t).has_value();
  }
  CHECK(apart > 0);
}

TEST_CASE("stalls without time in between are refused") {
  auto p = named("ideal");
  p.stalls = {4, 240ms, 295ms};
  CHECK_THROWS_AS(link_channel(p).stalls(), std::invalid_argument);
}

TEST_CASE("messages of all vehicles queue for the radio cell") {
  auto p = named("ideal");
  p.airtime = delay_distribution::uniform(2ms, 2ms);
  const auto cell = std::make_shared<shared_server_queue>(1);
  link_direction a{link_channel(p, 1), direction::up, cell};
  link_direction b{link_channel(p, 2), direction::up, cell};
  link_direction elsewhere{link_channel(p, 3), direction::up, nullptr};
  CHECK(a.arrival(time_point{0ms}, kind::other, 0) == time_point{2ms});
  CHECK(b.arrival(time_point{1ms}, kind::other, 0) == time_point{4ms});
  CHECK(elsewhere.arrival(time_point{1ms}, kind::other, 0) == time_point{3ms});
}

TEST_CASE("named profiles lose nothing") {
  for (const auto name : channel_profile_names())
    if (name != "trace")
      CHECK(share_lost(named(name), 5000) == 0);
}

TEST_CASE("plain loss takes its share of messages") {
  auto p = named("ideal");
  p.loss = 0.05;
  CHECK(share_lost(p, 100'000) == near(0.05, 0.05));
}

TEST_CASE("burst loss takes its share, in bursts") {
  auto p = named("ideal");
  p.burst_loss = {9s, 1s, 0.01, 0.8};
  constexpr auto count = 400'000;
  const auto arrivals =
      results({link_channel(p), direction::down, nullptr}, count);
  double lost = 0;
  double lost_twice = 0;
  for (auto n = 1; n < count; ++n) {
    lost += !arrivals[n];
    lost_twice += !arrivals[n - 1] && !arrivals[n];
  }
  const auto expected = 0.9 * 0.01 + 0.1 * 0.8;
  CHECK(lost / count == near(expected, 0.05));
  // Mostly both in the bad state: far more than expected² = 0.8 %.
  CHECK(lost_twice / count > 0.05);
}

TEST_CASE("loss does not shift the delays of what arrives") {
  const auto p = named("paper_5g");
  auto lossy = p;
  lossy.loss = 0.3;
  const auto all = results({link_channel(p), direction::down, nullptr}, 50'000);
  const auto some =
      results({link_channel(lossy), direction::down, nullptr}, 50'000);
  double arrived = 0;
  double delay_ms = 0;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (some[n]) {
      REQUIRE(some[n] == all[n]);
      ++arrived;
      delay_ms += to_milliseconds(*some[n] - cycle(n));
    }
  CHECK(delay_ms / arrived == near(5 + 3.74 + 0.2, 0.01));
}

TEST_CASE("a replayed result takes the measured round trip, a request none") {
  link_direction down{link_channel(measured()), direction::down, nullptr};
  link_direction up{link_channel(measured()), direction::up, nullptr};
  CHECK(down.arrival(time_point{0s}, kind::result, 0) == time_point{20ms});
  CHECK(down.arrival(time_point{1s}, kind::result, 1) == time_point{1030ms});
  CHECK(down.arrival(time_point{2s}, kind::result, 2) == time_point{2250ms});
  CHECK(up.arrival(time_point{2s}, kind::other, 0) == time_point{2s});
  CHECK(compute_measured_with("trace").mean_s() == 0);
}

TEST_CASE("vehicles replay a trace from places of their own if they may") {
  auto p = measured();
  const auto alike = [&] {
    auto same = 0;
    for (station_id::rep s = 1; s <= 100; ++s)
      same += link_channel(p, s).downlink_delay(0, time_point{}) == 20ms;
    return same;
  };
  CHECK(alike() == 100);
  p.scatters_trace = true;
  CHECK(alike() == near(33, 0.5));
}

TEST_CASE("a trace without samples cannot be replayed") {
  CHECK_THROWS_AS(link_channel(named("trace")), std::invalid_argument);
}

TEST_CASE("the radio of a laboratory is on top of what its broker takes") {
  const auto loopback = named("amqp_loopback"), lab = named("amqp_lab"),
             radio = named("paper_5g");
  const auto delay = [](const channel_profile& p, direction to,
                        std::uint64_t k) {
    const channel_draws draws{std::make_shared<const channel_profile>(p),
                              random_stream{1, "network"}, 101, 0};
    return draws.network_delay({to, message_class::result, k},
                               time_point{50ms * k});
  };
  for (std::uint64_t k = 0; k < 100; ++k) {
    CHECK(delay(loopback, direction::up, k) == 0ms);
    CHECK(delay(lab, direction::up, k) == delay(radio, direction::up, k));
    const auto sum =
        delay(loopback, direction::down, k) + delay(radio, direction::down, k);
    CHECK(std::chrono::abs(delay(lab, direction::down, k) - sum) <= 2ns);
  }
}

TEST_CASE("a profile is found by its name alone") {
  for (const auto name : channel_profile_names())
    CHECK(named(name).name == name);
  CHECK(!find_channel_profile("5g"));
}

TEST_CASE("what a message waits for is told apart from what it travels") {
  SUBCASE("its turn in the cell") {
    auto p = named("ideal");
    p.airtime = delay_distribution::uniform(2ms, 2ms);
    p.more_delay = 5ms;
    const auto cell = std::make_shared<shared_server_queue>(1);
    link_direction link{link_channel(p), direction::up, cell};
    CHECK(link.carry(time_point{0ms}, kind::other, 0).wait == 0ms);
    const auto second = link.carry(time_point{1ms}, kind::other, 1);
    CHECK(second.arrives == time_point{9ms});
    CHECK(second.wait == 1ms);
  }
  SUBCASE("messages before it") {
    auto p = named("ideal");
    p.network = delay_distribution::uniform(0ms, 200ms);
    link_direction link{link_channel(p), direction::up, nullptr};
    auto last = time_point{};
    auto waited = 0;
    for (std::uint64_t n = 0; n < 100; ++n) {
      const auto through = link.carry(time_point{n * 10ms}, kind::other, n);
      REQUIRE(through.wait >= 0ms);
      if (through.wait > 0ms) {
        CHECK(through.arrives == last);
        ++waited;
      }
      last = through.arrives.value();
    }
    CHECK(waited > 10);
  }
  SUBCASE("its turn, which comes after the end of a stall: not held by it") {
    auto p = named("ideal");
    p.stalls = {0.5, 200ms, 300ms};
    p.airtime = delay_distribution::uniform(400ms, 400ms);
    const auto cell = std::make_shared<shared_server_queue>(1);
    link_direction link{link_channel(p), direction::down, cell};
    for (std::uint64_t n = 0; n < 100; ++n)
      REQUIRE(link.carry(cycle(n), kind::result, n).by == disturbance::none);
  }
  SUBCASE("the end of a stall") {
    auto p = named("ideal");
    p.stalls = {0.5, 200ms, 300ms};
    link_direction link{link_channel(p), direction::down, nullptr};
    auto waited = 0;
    for (std::uint64_t n = 0; n < 1000; ++n) {
      const auto through = link.carry(cycle(n), kind::result, n);
      waited += through.by == disturbance::stall && through.wait > 0ms;
      REQUIRE((through.by == disturbance::none
               || through.by == disturbance::stall));
    }
    CHECK(waited > 10);
  }
}

TEST_CASE("a link says of a message that the network delivered it late") {
  auto slow = measured();
  slow.trace = {{0, 0.049}, {1, 0.050}, {2, 0.001}};
  link_direction link{link_channel(slow), direction::down, nullptr};
  const auto by = [&link](time_point sent, std::uint64_t number) {
    return link.carry(sent, kind::result, number, 0).by;
  };
  CHECK(by(time_point{}, 0) == disturbance::none);
  CHECK(by(time_point{1s}, 1) == disturbance::slow);
  CHECK(by(time_point{2s}, 2) == disturbance::none);
}

TEST_CASE("a message is as late as the slow one before it") {
  auto slow = measured();
  slow.trace = {{0, 0.200}, {1, 0.001}};
  link_direction link{link_channel(slow), direction::down, nullptr};
  const auto by = [&link](time_point sent, std::uint64_t number) {
    return link.carry(sent, kind::result, number, 0).by;
  };
  CHECK(by(time_point{}, 0) == disturbance::slow);
  CHECK(by(time_point{10ms}, 1) == disturbance::slow);
  CHECK(by(time_point{1s}, 2) == disturbance::none);
}

TEST_CASE("a link says by what it lost a message") {
  auto p = named("ideal");
  p.loss = 0.5;
  p.outages = {{1s, 2s}};
  link_direction link{link_channel(p), direction::down, nullptr};
  auto by_chance = 0;
  for (int n = 0; n < 300; ++n) {
    const duration sent = n * 10ms;
    const auto through =
        link.carry(time_point{sent}, kind::other, static_cast<unsigned>(n));
    const auto out = sent >= 1s && sent < 2s;
    CHECK(through.arrives.has_value() == (through.by == disturbance::none));
    CHECK((through.by == disturbance::outage) == out);
    by_chance += through.by == disturbance::loss;
  }
  CHECK(by_chance > 60);
  CHECK(by_chance < 140);
}

TEST_CASE("an outage of one direction is none of the other one") {
  auto p = named("ideal");
  p.outages = {{1s, 2s, "up"}, {3s, 4s, "down"}};
  link_direction up{link_channel(p), direction::up, nullptr};
  link_direction down{link_channel(p), direction::down, nullptr};
  const auto by = [](link_direction& link, duration sent) {
    return link.carry(time_point{sent}, kind::other, 1).by;
  };
  CHECK(by(up, 1500ms) == disturbance::outage);
  CHECK(by(down, 1500ms) == disturbance::none);
  CHECK(by(up, 3500ms) == disturbance::none);
  CHECK(by(down, 3500ms) == disturbance::outage);
}

TEST_CASE("without disorder none is copied or overtaken, with it as many as it "
          "says, by at most so much") {
  auto p = named("ideal");
  link_direction orderly{link_channel(p), direction::down, nullptr};
  p.disorder = {0.2, 0.1, 30ms};
  link_direction link{link_channel(p), direction::down, nullptr};
  constexpr int all = 10'000;
  int copied = 0, overtaken = 0, out_of_order = 0;
  auto last = time_point::min();
  for (int n = 0; n < all; ++n) {
    const time_point sent{n * 10ms};
    const auto number = static_cast<std::uint64_t>(n);
    const auto plain = orderly.carry(sent, kind::other, number);
    CHECK_FALSE(plain.copy_arrives);
    CHECK_FALSE(plain.is_overtaken);
    const auto x = link.carry(sent, kind::other, number);
    REQUIRE(x.arrives);
    CHECK(*x.arrives >= *plain.arrives);
    CHECK(*x.arrives <= *plain.arrives + 30ms);
    CHECK((*x.arrives == *plain.arrives) != x.is_overtaken);
    if (x.copy_arrives) {
      CHECK(*x.copy_arrives >= *x.arrives);
      CHECK(*x.copy_arrives <= *x.arrives + 30ms);
    }
    copied += x.copy_arrives.has_value();
    overtaken += x.is_overtaken;
    out_of_order += *x.arrives < last;
    last = *x.arrives;
  }
  CHECK(copied > all * 0.18);
  CHECK(copied < all * 0.22);
  CHECK(overtaken > all * 0.09);
  CHECK(overtaken < all * 0.11);
  CHECK(out_of_order > all * 0.03);
}
