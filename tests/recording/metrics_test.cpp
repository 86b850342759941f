// What the figures of a run count.
#include "recording/metrics.hpp"

#include "base/random.hpp"
#include "tests/support/made_up_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sofof::made_up {

using namespace messages;
using namespace recording;
namespace {

/// The smallest number that a share p of all does not exceed.
double exact_quantile(std::vector<double> all, double p) {
  std::ranges::sort(all);
  const auto rank = std::ceil(p * static_cast<double>(all.size()));
  return all[static_cast<std::size_t>(rank) - 1];
}

} // namespace

TEST_CASE("a run is counted as the protocol says") {
  metrics m{run()};
  play(m);
  m.finish(at(100s));
  const auto& x = m.headline();
  CHECK(m.offers() == 2);
  CHECK(x.requests() == 5);
  CHECK(x.accepted == 4);
  CHECK(x.rejected == 1);
  CHECK(x.episodes == 3);
  CHECK(x.running_at_end == 1);
  CHECK(x.no_data == 1);
  CHECK(x.fallbacks == 1);
  const auto ended = [&x](end_reason why) {
    return x.ended_by[static_cast<std::size_t>(why)];
  };
  CHECK(ended(end_reason::left_area) == 1);
  CHECK(ended(end_reason::qos_gap) == 1);
  CHECK(ended(end_reason::no_data) == 1);
  CHECK(std::reduce(x.ended_by.begin(), x.ended_by.end())
        == x.episodes - x.running_at_end + x.no_data);
  CHECK(x.t_off_s.max() == doctest::Approx(20));
  CHECK(x.latency.ms().count() == 401);
  CHECK(x.latency.ms().max() == doctest::Approx(12.345678));
  CHECK(m.services().size() == 2);
  CHECK(m.services()[1].accepted == 1);
  CHECK(m.services()[1].episodes == 0);
}

TEST_CASE("a result that came too late counts in the latency, and as unused") {
  metrics m{run()};
  play(m);
  const auto before = m.headline();
  auto late = result({}, 1, 1s, 300ms, std::nullopt);
  late.session.service = planning;
  late.used = false;
  m.on_record(late);
  const auto& x = m.headline();
  CHECK(x.latency.ms().count() == before.latency.ms().count() + 1);
  CHECK(x.latency.ms().max() == doctest::Approx(300));
  CHECK(x.results_used == before.results_used);
}

TEST_CASE("implausible results are counted by the provider's name and the "
          "check") {
  metrics m{run()};
  const auto refuse = [&m](std::string check) {
    m.on_record(event_record{at(1s), event_type::implausible, 101, provider,
                             planning, 1, "with words", false,
                             std::move(check)});
  };
  refuse("road");
  refuse("road");
  refuse("others");
  const auto& counts = m.headline().implausible;
  REQUIRE(counts.size() == 1);
  CHECK(counts.at("mec").at("road") == 2);
  CHECK(counts.at("mec").at("others") == 1);
  CHECK(m.services()[1].implausible.empty());
}

TEST_CASE("an episode that still runs at the end counts up to the end, but has "
          "no t_off") {
  metrics m{run()};
  m.on_record(switched(running(), true, 90s));
  m.finish(at(100s));
  CHECK(m.headline().episodes == 1);
  CHECK(m.headline().t_off_s.count() == 0);
  CHECK(m.headline().offloaded_share(200s) == doctest::Approx(0.05));
}

TEST_CASE("the offloaded share is the sum of all t_off over the time driven") {
  metrics m{run()};
  play(m);
  m.finish(at(100s));
  const auto& x = m.headline();
  CHECK(x.offloaded_share(140s) == doctest::Approx((20 + 5 + 10) / 140.));
  CHECK_FALSE(x.offloaded_share(0s).has_value());
}

TEST_CASE("only the requester's side of an episode is counted") {
  metrics m{run()};
  auto provider_side = episode(running(), 10s, 30s, end_reason::left_area);
  provider_side.of = side::provider;
  m.on_record(provider_side);
  CHECK(m.headline().episodes == 0);
  CHECK(m.headline().t_off_s.count() == 0);
}

TEST_CASE("vehicles are offloaded now between switch and switch back") {
  metrics m{run()};
  CHECK(m.offloaded_now() == 0);
  m.on_record(switched(running(101), true, 10s));
  m.on_record(switched(running(102), true, 11s));
  m.on_record(switched(running(101, 1, "environment"), true, 11s));
  CHECK(m.offloaded_now() == 2);
  m.on_record(switched(running(101), false, 12s));
  CHECK(m.offloaded_now() == 1);
  m.on_record(episode(running(102), 11s, 13s, end_reason::left_area));
  CHECK(m.offloaded_now() == 0);
}

TEST_CASE("a hand-over to the next provider leaves its episode open") {
  auto next = running(101);
  next.provider = 2;
  metrics m{run()};
  m.on_record(switched(running(101), true, 10s));
  m.on_record(switched(next, true, 20s));
  m.on_record(episode(running(101), 10s, 20s, end_reason::left_area));
  CHECK(m.offloaded_now() == 1);
  m.finish(at(25s));
  CHECK(m.headline().episodes == 2);
  CHECK(m.headline().t_off_s.sum() == doctest::Approx(10));
}

TEST_CASE("what the end of a drive cuts off has no t_off") {
  metrics m{run()};
  m.on_record(switched(running(101), true, 10s));
  m.on_record(episode(running(101), 10s, 50s, end_reason::shutdown));
  m.on_record(switched(running(102), true, 20s));
  m.finish(at(50s));
  CHECK(m.headline().episodes == 2);
  CHECK(m.headline().t_off_s.count() == 0);
  // A provider that shuts down does not end the drive.
  auto by_provider = episode(running(101), 10s, 50s, end_reason::shutdown);
  by_provider.because = told_by_provider;
  m.on_record(by_provider);
  CHECK(m.headline().t_off_s.mean() == doctest::Approx(40));
}

TEST_CASE("who goes straight to the next provider is handed over, who was "
          "local between is not") {
  auto next = running(101);
  next.provider = 2;
  metrics m{run()};
  m.on_record(switched(running(101), true, 10s));
  m.on_record(switched(next, true, 20s));
  CHECK(m.headline().hand_overs == 1);
  m.on_record(switched(next, false, 30s));
  m.on_record(switched(running(101), true, 40s));
  CHECK(m.headline().hand_overs == 1);
  CHECK(m.headline().ping_pongs == 0);
}

TEST_CASE("who is remote again within five seconds of leaving has gone in "
          "vain") {
  metrics m{run()};
  m.on_record(switched(running(101), true, 10s));
  m.on_record(switched(running(101), false, 20s));
  SUBCASE("back in time") {
    m.on_record(switched(running(101, 2), true, 25s));
    CHECK(m.headline().ping_pongs == 1);
  }
  SUBCASE("at another provider") {
    auto next = running(101, 2);
    next.provider = 2;
    m.on_record(switched(next, true, 21s));
    CHECK(m.headline().ping_pongs == 1);
  }
  SUBCASE("too late to count") {
    m.on_record(switched(running(101, 2), true, 25s + 1ns));
    CHECK(m.headline().ping_pongs == 0);
  }
  SUBCASE("somebody else") {
    m.on_record(switched(running(102), true, 21s));
    CHECK(m.headline().ping_pongs == 0);
  }
}

TEST_CASE("a hand-over is in vain if the next one goes back") {
  auto next = running(101);
  next.provider = 2;
  metrics m{run()};
  m.on_record(switched(running(101), true, 10s));
  m.on_record(switched(next, true, 20s));
  CHECK(m.headline().ping_pongs == 0);
  m.on_record(switched(running(101, 2), true, 23s));
  CHECK(m.headline().ping_pongs == 1);
  CHECK(m.headline().hand_overs == 2);
}

TEST_CASE("fairness is one when all are offloaded alike, 1/n for one alone") {
  metrics m{run()};
  CHECK_FALSE(m.headline().fairness(2));
  m.on_record(episode(running(101), 10s, 30s, end_reason::left_area));
  CHECK(m.headline().fairness(2) == doctest::Approx(0.5));
  m.on_record(episode(running(102), 10s, 20s, end_reason::left_area));
  CHECK(m.headline().fairness(2) == doctest::Approx(0.9)); // 30² / (2 · 500)
  m.on_record(switched(running(102, 2), true, 40s));
  m.finish(at(50s));
  CHECK(m.headline().fairness(2) == doctest::Approx(1));
  CHECK_FALSE(m.headline().fairness(0));
}

TEST_CASE("results without an inter-arrival time are not counted as zero") {
  metrics m{run()};
  m.on_record(result(running(101, 1), 0, 1s, 9ms, std::nullopt));
  CHECK(m.headline().interarrival.ms().count() == 0);
  m.on_record(result(running(101, 1), 1, 2s, 9ms, 50ms));
  m.on_record(result(running(101, 1), 2, 2s, 9ms, 0ms)); // released together
  CHECK(m.headline().interarrival.ms().count() == 2);
  CHECK(m.headline().interarrival.ms().mean() == doctest::Approx(25));
}

TEST_CASE("one touch, one second off the road or with an old plan is unsafe") {
  metrics m{run()};
  m.on_record(safety_record{101, 10s, 0s, 0s, 150ms});
  m.on_record(safety_record{102, 10s, 0s, 0s, 120ms});
  CHECK(m.safety().ok());
  CHECK(m.safety().driven == duration{20s});
  CHECK(m.safety().max_plan_age == duration{150ms});
  SUBCASE("old plan") {
    m.on_record(safety_record{101, 1s, 1ns, 0s, 201ms});
  }
  SUBCASE("off the road") {
    m.on_record(safety_record{101, 1s, 0s, 1s, 0ms});
  }
  SUBCASE("touch") {
    m.on_record(collision_record{at(3s), 101, 102});
  }
  CHECK_FALSE(m.safety().ok());
}

TEST_CASE("all vehicles together have the sums and extremes of each") {
  metrics m{run()};
  play(m);
  const auto& all = m.together();
  CHECK(all.safety.driven == duration{200s});
  CHECK(all.plans.count == 3000);
  CHECK(all.plans.emergency == 3);
  CHECK(all.plans.kept == 5);
  CHECK(all.plans.stops == 2);
  CHECK(all.plans.imperfect == 7);
  CHECK(all.plans.safe_stops == 1);
  CHECK(all.plans.extremes.lateral_accel_mps2 == 2);
  CHECK(all.ride.distance_m == 1700.5);
  CHECK(all.ride.extremes.jerk_mps3 == 2);
  CHECK(all.ride.extremes.min_accel_mps2 == -4);
  CHECK(all.ride.hard_brakes == 2);
  CHECK(all.ride.comfort_cost_m2ps3 == 100.5);
  REQUIRE(m.vehicles().size() == 2);
  const auto& one = m.vehicles().at(102);
  CHECK(one.safety.max_plan_age == duration{180ms});
  CHECK(one.plans.count == 1000);
  CHECK(one.ride.hard_brakes == 0);
}

TEST_CASE("a vehicle's figures are those of all its records") {
  metrics m{run()};
  for (auto i = 0; i < 3; ++i) {
    m.on_record(safety_record{101, 1s, 0s, 0s, 100ms});
    m.on_record(drive_record{101, {20, 1, 0, 0, 0, 0, {}}, {10, {}, 1, 2}});
  }
  const auto& x = m.vehicles().at(101);
  CHECK(x.safety.driven == duration{3s});
  CHECK(x.plans.count == 60);
  CHECK(x.ride.distance_m == 30);
  CHECK(x.ride.hard_brakes == 3);
}

TEST_CASE("where nobody's trip has ended there is no delay") {
  const metrics m{run()};
  CHECK(!m.traffic().delay_s().mean());
  CHECK(!m.traffic().delay_s(0.95));
  CHECK(!m.traffic().longest_stop_s());
  CHECK(m.traffic().arrived() == 0);
}

TEST_CASE("of twenty delays nineteen are no longer than the 95 % one") {
  metrics m{run()};
  for (auto k = 20; k > 0; --k)
    m.on_record(trip_record{static_cast<std::uint32_t>(k),
                            {100. + k, 100, 1, k / 2., k % 2 == 0}});
  const auto& x = m.traffic();
  CHECK(x.delay_s(0.95) == 19);
  CHECK(x.delay_s(1) == 20);
  CHECK(x.delay_s(0.01) == 1);
  CHECK(x.delay_s().mean() == 10.5);
  CHECK(x.longest_stop_s() == 10);
  CHECK(x.stops() == 20);
  CHECK(x.arrived() == 10);
  CHECK(m.vehicles().at(7).trip->delay_s() == 7);
}

TEST_CASE("cycles at the top are those of the headline service") {
  metrics m{run()};
  m.on_record(result(running(101, 1, "environment"), 1, 5s, 10ms, {}));
  m.on_record(work_record{101, "environment", 7, 0});
  CHECK(m.cycles().offloaded == 0);
  m.on_record(work_record{101, planning, 3, 0});
  m.on_record(work_record{101, planning, 2, 0});
  CHECK(m.cycles().on_board == 5);
  CHECK(m.cycles(101).on_board == 5);
  CHECK(m.work().energy().j() == 5 * 0.5);
}

TEST_CASE("a touch counts once for the run and once for either vehicle") {
  metrics m{run()};
  m.on_record(collision_record{at(3s), 101, 102});
  CHECK(m.safety().collisions == 1);
  CHECK(m.vehicles().at(101).safety.collisions == 1);
  CHECK(m.vehicles().at(102).safety.collisions == 1);
}

TEST_CASE("a near miss counts for the run") {
  metrics m{run()};
  m.on_record(
      event_record{at(3s), event_type::near_miss, 101, 0, {}, 0, "with 102"});
  CHECK(m.safety().near_misses == 1);
  CHECK(m.safety().ok());
}

TEST_CASE("an obstacle that is touched is no vehicle") {
  auto info = run();
  info.obstacles = 2;
  metrics m{info};
  m.on_record(collision_record{at(3s), 101, obstacle_id(0)});
  m.on_record(collision_record{at(4s), 101, obstacle_id(1)});
  m.on_record(
      collision_record{at(5s), 101, obstacle_id(2)}); // there are but two
  CHECK(m.safety().collisions == 3);
  CHECK(m.vehicles().at(101).safety.collisions == 3);
  CHECK(m.vehicles().size() == 2);
  CHECK(m.vehicles().contains(obstacle_id(2)));
}

TEST_CASE("every switch of plans counts with its jumps") {
  metrics m{run()};
  CHECK(m.switches().count() == 0);
  play(m);
  const auto& x = m.switches();
  CHECK(x.count() == 2);
  CHECK(x.d_m.max() == 0.75);
  CHECK(x.d_m.mean() == doctest::Approx(0.5));
  CHECK(x.curvature_1pm.max() == 0.002);
  CHECK(x.speed_mps.max() == 0.5);
  CHECK(x.accel_mps2.max() == 1);
}

TEST_CASE("a run without the headline's service has empty headlines") {
  auto info = run();
  info.services = {"environment"};
  metrics m{info};
  m.on_record(decision(true, "environment"));
  CHECK(m.headline().requests() == 0);
  CHECK(m.services().size() == 1);
}

TEST_CASE("nothing has no mean, no spread and no quantile") {
  statistics s;
  distribution d;
  CHECK_FALSE(s.mean().has_value());
  CHECK_FALSE(s.max().has_value());
  CHECK_FALSE(d.quantile_ms(0.5).has_value());
  s.add(-3);
  CHECK(s.mean() == -3);
  CHECK(s.max() == -3);
  CHECK_FALSE(s.deviation().has_value());
}

TEST_CASE("quantiles are the exact ones, rounded up to 0.01 ms") {
  const random_stream noise{1, "quantiles"};
  distribution d;
  std::vector<double> all;
  double sum = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const auto x = from_seconds(noise.exponential(0.011, i));
    d.add(x);
    all.push_back(to_milliseconds(x));
    sum += all.back();
  }
  const auto mean = sum / static_cast<double>(all.size());
  double squares = 0;
  for (const auto x : all)
    squares += (x - mean) * (x - mean);
  CHECK(d.ms().mean() == doctest::Approx(mean));
  CHECK(d.ms().deviation()
        == doctest::Approx(
            std::sqrt(squares / static_cast<double>(all.size() - 1))));
  for (const auto p : {0.01, 0.5, 0.99, 0.999, 1.0}) {
    const auto exact = exact_quantile(all, p);
    CAPTURE(p);
    CHECK(*d.quantile_ms(p) >= exact);
    CHECK(*d.quantile_ms(p) <= exact + 0.01);
  }
  CHECK(d.quantile_ms(1) == d.ms().max());
}

TEST_CASE("durations on the histogram's grid are reported as they are") {
  distribution d;
  for (const auto ms : {50, 50, 50, 100})
    d.add(std::chrono::milliseconds{ms});
  CHECK(d.quantile_ms(0.5) == doctest::Approx(50).epsilon(1e-12));
  CHECK(d.quantile_ms(0.75) == doctest::Approx(50).epsilon(1e-12));
  CHECK(d.quantile_ms(0.76) == doctest::Approx(100).epsilon(1e-12));
}

TEST_CASE("beyond the histogram a quantile is the maximum") {
  distribution d;
  d.add(2ms);
  d.add(distribution::span + 1s);
  CHECK(d.quantile_ms(0.5) == doctest::Approx(2));
  CHECK(d.quantile_ms(0.99) == doctest::Approx(11'000));
}

TEST_CASE("a finer histogram tells shorter durations apart") {
  distribution d{100ns, 1ms};
  for (const auto ns : {130, 140, 250, 900})
    d.add(std::chrono::nanoseconds{ns});
  CHECK(d.quantile_ms(0.5) == doctest::Approx(200e-6));
  CHECK(d.quantile_ms(0.75) == doctest::Approx(300e-6));
  d.add(2ms);
  CHECK(d.quantile_ms(1) == doctest::Approx(2));
}

TEST_CASE("clocks that differ may make a latency negative") {
  distribution d;
  d.add(-1ms);
  d.add(-3ms);
  CHECK(d.ms().mean() == doctest::Approx(-2));
  CHECK(d.quantile_ms(0.99) == doctest::Approx(-1));
}

TEST_CASE("a bin counts what is above the one before, up to its bound") {
  distribution d;
  for (const auto us : {0, 10, 100, 101, 200, 730})
    d.add(std::chrono::microseconds{us});
  d.add(12s); // beyond the span
  const auto bins = d.bins(100us);
  REQUIRE(bins.size() == 5);
  const std::pair<double, std::uint64_t> expected[] = {
      {0, 1}, {0.1, 2}, {0.2, 2}, {0.8, 1}, {12000, 1}};
  for (std::size_t i = 0; i < bins.size(); ++i) {
    CHECK(bins[i].up_to_ms == doctest::Approx(expected[i].first));
    CHECK(bins[i].count == expected[i].second);
  }
}

} // namespace sofof::made_up
