// Good and bad phases, spikes, outages, and radios of their own.
#include "channel/link_direction.hpp"
#include "channel/provider_compute.hpp"
#include "tests/channel/cycles.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace sofof;
using namespace sofof::channel;
using test::cycle;
using test::near;
using namespace std::chrono_literals;

namespace {

const random_stream phase_seed{1, "phases"};

channel_draws phase_channel(const channel_profile& p, station_id station = 1,
                            std::uint32_t provider = 0,
                            std::string_view radio = {}) {
  return {std::make_shared<channel_profile>(p), phase_seed, station, provider,
          radio};
}

/// 10 ms for everything, but for what a test adds.
channel_profile constant() {
  channel_profile p;
  p.network = delay_distribution::uniform(10ms, 10ms);
  return p;
}

channel_profile drifting() {
  auto p = constant();
  p.drift = {0.5, 4s};
  return p;
}

/// g(t), as the delay of a message shows it.
double g(const channel_draws& of, time_point t, std::uint64_t number = 0) {
  return std::log(to_seconds(of.downlink_delay(number, t)) / 0.010) / 0.5;
}

double mean_of_products(duration lag, std::uint64_t count) {
  const auto one = phase_channel(drifting());
  double sum = 0;
  for (std::uint64_t n = 0; n < count; ++n)
    sum += g(one, cycle(n)) * g(one, cycle(n) + lag);
  return sum / static_cast<double>(count);
}

struct shares {
  double late = 0;       ///< Of all, later than 50 ms.
  double after_late = 0; ///< Of those 1 s after one that was.
};

shares late_results(const channel_profile& p, std::uint64_t count) {
  std::vector<bool> late;
  const auto computers = compute_measured_with(p.name);
  for (station_id::rep v = 1; v <= 40; ++v) {
    const auto one = phase_channel(p, v);
    const auto draws = result_draws(phase_seed, v, 0);
    for (std::uint64_t n = 0; n < count; ++n)
      late.push_back(computers.computing_time(draws, n)
                         + one.downlink_delay(n, cycle(n))
                     > 50ms);
  }
  constexpr std::size_t second = 20;
  double all = 0;
  double both = 0;
  for (std::size_t i = 0; i + second < late.size(); ++i) {
    all += late[i];
    both += late[i] && late[i + second];
  }
  return {all / static_cast<double>(late.size()), both / all};
}

} // namespace

TEST_CASE("drift is a function of time, whatever is sent") {
  const auto one = phase_channel(drifting());
  const auto later = g(one, cycle(1000));
  g(one, cycle(3));
  CHECK(g(one, cycle(1000)) == later);
  CHECK(g(one, cycle(1000), 77) == later);
  CHECK(
      phase_channel(drifting())
          .network_delay({direction::up, message_class::other, 5}, cycle(1000))
      == one.downlink_delay(0, cycle(1000)));
  CHECK(g(phase_channel(drifting(), 2), cycle(1000)) != later);
  CHECK(g(phase_channel(drifting(), 1, 1), cycle(1000)) != later);
}

TEST_CASE("drift is as wide at any time, and forgets within its period") {
  CHECK(mean_of_products(0s, 400'000) == near(1, 0.05));
  CHECK(mean_of_products(50ms, 400'000) > 0.95);
  CHECK(mean_of_products(2s, 400'000) == near(0.755, 0.15));
  CHECK(std::abs(mean_of_products(8s, 400'000)) < 0.05);
}

TEST_CASE("without drift, delays are those of the profile") {
  CHECK(phase_channel(constant()).downlink_delay(3, cycle(3)) == 10ms);
  auto p = drifting();
  p.more_delay = 5ms; // is not stretched
  const auto stretched = phase_channel(p).downlink_delay(3, cycle(3)) - 5ms;
  CHECK(stretched == phase_channel(drifting()).downlink_delay(3, cycle(3)));
}

TEST_CASE("spikes come at their rate, as long as they may be") {
  auto p = constant();
  p.spikes = {0.01, 20ms, 60ms};
  const auto one = phase_channel(p);
  auto longer = 0;
  for (std::uint64_t n = 0; n < 100'000; ++n) {
    const auto extra = one.downlink_delay(n, cycle(n)) - 10ms;
    if (extra == 0ns)
      continue;
    ++longer;
    CHECK(extra >= 20ms);
    CHECK(extra <= 60ms);
  }
  CHECK(longer == near(1000, 0.1));
}

TEST_CASE("in an outage nothing gets through, before and after all does") {
  auto p = constant();
  p.outages = {{10s, 12s}, {20s, 21s}};
  link_direction link{phase_channel(p), direction::up, nullptr};
  link.begin(time_point{5s});
  for (std::uint64_t n = 0; n < 800; ++n) {
    const auto since = n * 50ms;
    const auto out =
        (since >= 10s && since < 12s) || (since >= 20s && since < 21s);
    CHECK(link.arrival(time_point{5s} + since, message_class::other, n)
              .has_value()
          == !out);
  }
}

TEST_CASE("each radio of a vehicle has stalls of its own") {
  auto p = constant();
  p.stalls = {0.5, 240ms, 295ms};
  p.burst_loss.mean_good = p.burst_loss.mean_bad = 500ms;
  auto one = phase_channel(p, 1, 0, "a").stalls();
  auto beside = phase_channel(p, 1, 1, "a").stalls();
  auto other = phase_channel(p, 1, 1, "b").stalls();
  auto nameless = phase_channel(p, 1, 1).stalls();
  auto fades = phase_channel(p, 1, 0, "a").fades();
  auto other_fades = phase_channel(p, 1, 0, "b").fades();
  auto apart = 0, apart_nameless = 0, fades_apart = 0, both = 0;
  for (auto t = time_point{}; t < time_point{1000s}; t += 50ms) {
    const auto stalled = one.at(t).has_value();
    const auto other_stalled = other.at(t).has_value();
    CHECK(stalled == beside.at(t).has_value());
    both += stalled && other_stalled;
    apart += stalled != other_stalled;
    apart_nameless += stalled != nameless.at(t).has_value();
    fades_apart += fades.at(t).has_value() != other_fades.at(t).has_value();
  }
  CHECK(apart > 1000);
  CHECK(apart_nameless > 1000);
  CHECK(fades_apart > 5000);
  CHECK(both == near(20'000 * 0.134 * 0.134, 0.4)); // as if by chance
}

TEST_CASE("spiky_5g is late in phases that can be foreseen") {
  auto calm = *find_channel_profile("spiky_5g");
  calm.spikes = {};
  const auto foreseeable = late_results(calm, 72'000);
  const auto all = late_results(*find_channel_profile("spiky_5g"), 72'000);
  MESSAGE("late without spikes: ", foreseeable.late,
          ", 1 s after a late one: ", foreseeable.after_late,
          "; with spikes: ", all.late, ", ", all.after_late);
  CHECK(foreseeable.late == near(0.015, 0.2));
  CHECK(foreseeable.after_late > 20 * foreseeable.late);
  CHECK(all.late > foreseeable.late + 0.001);
  CHECK(all.late < foreseeable.late + 0.003);
}
