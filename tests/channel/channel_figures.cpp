// The named profiles give the latencies that they were made for; the same
// figures are in docs/channels.md.
#include "tests/support/fleet_latency.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <array>

using namespace sofof;
using namespace sofof::channel;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

fleet of(std::string_view name, std::uint32_t vehicles = 1) {
  return {std::make_shared<channel_profile>(*find_channel_profile(name)),
          vehicles};
}

} // namespace

TEST_CASE("an ideal channel adds no latency") {
  const auto l = latency_of(of("ideal", 6), 1);
  CHECK(l.mean_ms == 0);
  CHECK(l.sd_ms == 0);
}

TEST_CASE("paper_sim gives one vehicle 10.54 ± 9.83 ms, never over 50 ms") {
  const auto l = latency_of(of("paper_sim"), 200);
  CHECK(l.mean_ms == near(10.54, 0.03));
  CHECK(l.sd_ms == near(9.83, 0.03));
  CHECK(l.share_late == 0);
}

TEST_CASE("paper_sim grows slower with every vehicle that shares the worker") {
  // protocol figures for 1 to 6 vehicles, ± 5 %
  constexpr std::array mean_ms{10.5, 10.8, 11.0, 11.2, 11.5, 11.7};
  auto last = 0.0;
  for (std::uint32_t n = 1; n <= 6; ++n) {
    const auto l = latency_of(of("paper_sim", n), 200);
    CHECK(l.mean_ms == near(mean_ms[n - 1], 0.05));
    CHECK(l.sd_ms == near(9.8 + 0.08 * (n - 1), 0.05));
    CHECK(l.mean_ms > last);
    CHECK(l.share_late < 1e-3);
    last = l.mean_ms;
  }
}

TEST_CASE("paper_sim lets one vehicle offload longer when gaps may be longer") {
  const auto offloaded_s = [](duration longest_gap) {
    return mean_offloading_s(of("paper_sim"), longest_gap, 100);
  };
  CHECK(offloaded_s(50ms) == near(0.08, 0.1));
  CHECK(offloaded_s(60ms) == near(0.2, 0.1));
  CHECK(offloaded_s(70ms) == near(0.6, 0.1));
  CHECK(offloaded_s(80ms) == near(2.4, 0.1));
  CHECK(offloaded_s(90ms) == near(29, 0.3));
  CHECK(offloaded_s(100ms) == near(68, 0.01)); // all of the run
}

TEST_CASE("paper_sim_stalls has the same moments for another reason") {
  auto f = of("paper_sim_stalls");
  f.length = 5000s;
  const auto l = latency_of(f, 20);
  CHECK(l.mean_ms == near(10.54, 0.03));
  CHECK(l.sd_ms == near(9.83, 0.08)); // 1350 stalls only
  CHECK(l.share_late > 1e-3);
}

TEST_CASE("paper_5g gives 11.94 ± 2.98 ms to up to six vehicles") {
  for (const std::uint32_t n : {1, 6}) {
    const auto l = latency_of(of("paper_5g", n), 100);
    CHECK(l.mean_ms == near(11.94, 0.03));
    CHECK(l.sd_ms == near(2.98, 0.03));
    CHECK(l.share_late < 2e-4);
  }
}

TEST_CASE("paper_5g stays itself at the 100 Hz of the test drives") {
  auto f = of("paper_5g");
  f.period = 10ms;
  const auto l = latency_of(f, 20);
  CHECK(l.mean_ms == near(11.94, 0.03));
  CHECK(l.sd_ms == near(2.98, 0.03));
}

TEST_CASE("the measured 5G profiles have the measured moments") {
  struct expected {
    std::string_view name;
    double mean_ms;
  };
  for (const auto& [name, mean_ms] :
       {expected{"cicv5g_n8", 19.3}, expected{"cicv5g_n78", 16.8}}) {
    auto f = of(name);
    f.length = 5000s;
    const auto l = latency_of(f, 20);
    CHECK(l.mean_ms == near(mean_ms, 0.03));
    CHECK(l.sd_ms > 8.5);
    CHECK(l.sd_ms < 10.5);
  }
}
