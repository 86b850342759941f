// Tests of what providers compute with.
#include "channel/provider_compute.hpp"

#include "channel/channel_draws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string_view>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;

namespace {

const random_stream compute_seed{1, "network"};
constexpr station_id computed_for = 101;
constexpr std::uint32_t computed_at = 2;

random_stream draws_here(std::string_view radio = {}) {
  return result_draws(compute_seed, computed_for, computed_at, radio);
}

channel_draws channel_here(std::string_view profile) {
  return {
      std::make_shared<const channel_profile>(*find_channel_profile(profile)),
      compute_seed, computed_for, computed_at};
}

} // namespace

TEST_CASE("each channel profile has the computers it was measured with") {
  struct figures {
    std::string_view profile;
    std::int64_t workers;
    double mean_s, deviation_s;
  };
  for (const auto& x :
       {figures{"ideal", 1, 0, 0},
        figures{"paper_sim", 1, 3.16437e-3, 2.95086e-3},
        figures{"paper_sim_correlated", 1, 3.16437e-3, 2.95086e-3},
        figures{"paper_sim_stalls", 1, 0, 0},
        figures{"paper_5g", 2, 3e-3, 1e-3}, figures{"cicv5g_n8", 1, 0, 0},
        figures{"cicv5g_n78", 1, 0, 0}, figures{"spiky_5g", 8, 3e-3, 1e-3},
        figures{"amqp_loopback", 1, 0, 0}, figures{"amqp_lab", 1, 0, 0},
        figures{"trace", 1, 0, 0}}) {
    CAPTURE(x.profile);
    REQUIRE(find_channel_profile(x.profile));
    const auto c = compute_measured_with(x.profile);
    CHECK(c.model == x.profile);
    CHECK(c.workers == x.workers);
    CHECK(c.more_computing == 0ms);
    CHECK(std::abs(c.mean_s() - x.mean_s) < 1e-6);
    CHECK(std::abs(c.deviation_s() - x.deviation_s) < 1e-6);
  }
  CHECK(channel_profile_names().size() == 11);
}

TEST_CASE("mean and deviation of computing times are those of the draws") {
  for (const auto name : {"paper_sim", "paper_5g"}) {
    CAPTURE(name);
    const auto c = compute_measured_with(name);
    const auto draws = draws_here();
    constexpr int count = 40000;
    double sum = 0, squares = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
      const auto x = to_seconds(c.computing_time(draws, k));
      sum += x;
      squares += x * x;
    }
    const auto mean = sum / count;
    CHECK(c.mean_s() == doctest::Approx(mean).epsilon(0.015));
    CHECK(c.deviation_s()
          == doctest::Approx(std::sqrt(squares / count - mean * mean))
                 .epsilon(0.03));
  }
}

TEST_CASE(
    "paper_sim shares out one draw a result, 3 of 10 parts to computing") {
  const auto c = compute_measured_with("paper_sim");
  const auto way = channel_here("paper_sim");
  for (std::uint64_t k = 0; k < 100; ++k) {
    const auto computing_s = to_seconds(c.computing_time(draws_here(), k));
    const auto network_s = to_seconds(way.downlink_delay(k, {}));
    CHECK(std::abs(computing_s / 0.3 - network_s / 0.7) < 4e-9);
    CHECK(computing_s > 0);
  }
}

TEST_CASE("computing times belong to a vehicle, a provider and a radio") {
  const auto c = compute_measured_with("paper_5g");
  const auto one = c.computing_time(draws_here(), 7);
  CHECK(one == c.computing_time(draws_here(), 7));
  CHECK(one != c.computing_time(draws_here(), 8));
  CHECK(one != c.computing_time(draws_here("a"), 7));
  CHECK(one != c.computing_time(result_draws(compute_seed, 102, 2), 7));
  CHECK(one != c.computing_time(result_draws(compute_seed, 101, 1), 7));
}

TEST_CASE("a service computes as long as it demands, the constant part too") {
  auto c = compute_measured_with("paper_5g");
  const auto plain = c.computing_time(draws_here(), 3);
  const auto mean_s = c.mean_s();
  c.more_computing = 8ms;
  CHECK(c.mean_s() == doctest::Approx(mean_s + 0.008));
  CHECK(c.computing_time(draws_here(), 3) - plain == 8ms);
  CHECK(c.computing_time(draws_here(), 3, 2) == 2 * (plain + 8ms));
  CHECK(c.computing_time(draws_here(), 3, 0) == 0ms);
}

TEST_CASE(
    "a computing time exceeds its bound where its law has no end, rarely") {
  auto paper = compute_measured_with("paper_sim");
  paper.more_computing = 2ms;
  CHECK(paper.bound().at_most_s == doctest::Approx(2e-3 + 0.3 * 45e-3));
  CHECK(paper.bound().probability == 0);
  const auto draws = draws_here();
  for (std::uint64_t k = 0; k < 20000; ++k)
    CHECK(paper.computing_time(draws, k, 1.7)
          <= from_seconds(paper.bound().at_most_s * 1.7));
  const auto endless = compute_measured_with("paper_5g");
  CHECK(endless.bound().probability == rare);
  CHECK(endless.bound().at_most_s > endless.mean_s());
  CHECK(endless.bound().beyond_s > 0);
}
