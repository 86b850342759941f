// How long software waits for a core of a host that all vehicles share.
#include "channel/core_wait.hpp"

#include "channel/channel_draws.hpp"
#include "channel/server_queue.hpp"
#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <memory>

using namespace sofof;
using namespace sofof::channel;
using namespace std::chrono_literals;
using test::near;

TEST_CASE("software waits as long as jobs in a queue before as many servers") {
  const host_options host{.cores = 4, .busy_cores = 0.56, .turn = 4ms};
  const auto wait = wait_for_core(host, 6); // 84 % of the cores
  // The same queue, job by job.
  server_queue queue{4};
  const random_stream noise{1, "jobs"};
  double waited_s = 0, waited = 0;
  time_point now{};
  constexpr std::uint64_t jobs = 400'000;
  for (std::uint64_t k = 0; k < jobs; ++k) {
    now += from_seconds(noise.exponential(0.004 / (6 * 0.56), k, 0));
    const auto work = from_seconds(noise.exponential(0.004, k, 1));
    const auto wait_s = to_seconds(queue.finish(now, work) - now - work);
    waited += wait_s > 1e-9 ? 1 : 0;
    waited_s += wait_s;
  }
  CHECK(wait.probability == near(waited / jobs, 0.02));
  CHECK(wait.probability * to_seconds(wait.mean)
        == near(waited_s / jobs, 0.04));
  // And the draws have that mean.
  double drawn_s = 0;
  for (std::uint64_t k = 0; k < jobs; ++k)
    drawn_s += to_seconds(wait.draw(noise, k));
  CHECK(drawn_s / jobs == near(waited_s / jobs, 0.05));
}

TEST_CASE("more vehicles on a host wait longer, one on its own hardly") {
  const host_options host{.cores = 4, .busy_cores = 0.56, .turn = 4ms};
  double before_s = 0;
  for (int vehicles = 1; vehicles <= 7; ++vehicles) {
    const auto wait = wait_for_core(host, vehicles);
    const auto mean_s = wait.probability * to_seconds(wait.mean);
    CHECK(mean_s > before_s);
    before_s = mean_s;
  }
  const auto alone = wait_for_core(host, 1);
  CHECK(alone.probability * to_seconds(alone.mean) < 1e-5);
  CHECK(host.carries(7));
  CHECK_FALSE(host.carries(8)); // 4.48 cores
}

TEST_CASE("who has a computer of its own waits for nobody") {
  const auto wait = wait_for_core({}, 1000);
  for (std::uint64_t k = 0; k < 100; ++k)
    CHECK(wait.draw(random_stream{1, "any"}, k) == 0ns);
}

TEST_CASE("messages wait for the vehicles' host, both ways, on any channel") {
  for (const auto* name : {"ideal", "paper_sim", "paper_5g"}) {
    CAPTURE(name);
    const auto made = [&](bool loaded) {
      auto profile = *find_channel_profile(name);
      if (loaded)
        profile.vehicle_host = {.probability = 1, .mean = 5ms};
      return channel_draws{
          std::make_shared<const channel_profile>(std::move(profile)),
          random_stream{1, "network"}, 101, 0};
    };
    const auto plain = made(false), loaded = made(true);
    for (const auto to : {direction::up, direction::down}) {
      double more_s = 0;
      constexpr std::uint64_t messages = 20'000;
      for (std::uint64_t k = 0; k < messages; ++k) {
        const message_id id{to, message_class::other, k};
        more_s += to_seconds(loaded.network_delay(id, {})
                             - plain.network_delay(id, {}));
      }
      CHECK(more_s / messages == near(0.005, 0.03));
    }
  }
}
