// Tests of cycles whose functions a pool of threads computes, without any
// actor.
#include "offloading/service_cycle.hpp"
#include "tests/support/echo.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace {

/// A pool in which nobody computes before somebody waits.
struct idle_pool final : job_pool {
  idle_pool() : job_pool{0} {}
  bool has_helpers() const override { return true; }
  void begin(job_ptr) override { ++begun; }
  int begun = 0;
};

/// Cycles that go on while the world does.
struct pooled_world : offloading::cycle_port {
  struct late_copier final : offloading::service_function {
    offloading::service_output run(time_point,
                                   const service_input& input) override {
      steps.push_back(input.what.as<echo>()->number);
      if (steps.back() == 0)
        return {};
      return input.what;
    }
    offloading::begun_cycle begin(time_point now,
                                  const service_input& input) override {
      if (input.what.as<echo>()->number == 1)
        return run(now, input);
      return [this, now, input] { return run(now, input); };
    }
    void observe(time_point, const service_input& input) override {
      steps.push_back(100 + input.what.as<echo>()->number);
    }
    std::vector<std::uint64_t> steps;
  };

  time_point now{1s};
  std::shared_ptr<late_copier> function = std::make_shared<late_copier>();
  std::shared_ptr<idle_pool> pool = std::make_shared<idle_pool>();
  int finished = 0;
  std::vector<service_result> known;
  std::vector<offloading::coming_result> coming;
  std::optional<offloading::service_cycle> cycle{std::in_place, setup(), *this};

  offloading::cycle_setup setup() {
    offloading::cycle_setup x;
    x.session = {1, 101, "echo", 7};
    x.function = function;
    x.period = 50ms;
    x.per_input = true;
    x.pool = pool;
    x.finish = [this](time_point start, std::uint64_t) {
      ++finished;
      return offloading::cycle_work{start + 5ms, 3ms};
    };
    return x;
  }

  void wake_at(time_point, std::uint64_t) override {}
  void deliver_at(time_point, service_result result) override {
    known.push_back(std::move(result));
  }
  void deliver_at(time_point, offloading::coming_result result) override {
    coming.push_back(std::move(result));
  }

  void feed(std::uint64_t number) {
    now += 100ms;
    cycle->on_input({{1, 101, "echo", 7}, now, payload::of(echo{number})}, now);
  }
  void take(lifecycle_step step) { cycle->on_step(step, now); }
};

} // namespace

TEST_CASE_FIXTURE(pooled_world, "a cycle that a pool computes is due as if it "
                                "had been computed when it began") {
  take(lifecycle_step::configure);
  feed(9);
  take(lifecycle_step::activate);
  REQUIRE(coming.size() == 1);
  CHECK(pool->begun == 1);
  CHECK(function->steps == std::vector<std::uint64_t>{109});
  CHECK(coming[0].frame.created == now);
  CHECK(coming[0].frame.timing.computing == 3ms);
  CHECK(coming[0].frame.timing.queue == 2ms);
  const auto made = coming[0].take();
  REQUIRE(made);
  CHECK(made->what.as<echo>()->number == 9);
  CHECK(made->cycle == coming[0].frame.cycle);
}

TEST_CASE_FIXTURE(pooled_world, "a function does one thing after the other, "
                                "whoever computes") {
  take(lifecycle_step::configure);
  take(lifecycle_step::activate);
  feed(2);
  feed(3); // ends 2
  take(lifecycle_step::deactivate);
  feed(4); // ends 3
  CHECK(function->steps == std::vector<std::uint64_t>{2, 3, 104});
  for (auto& x : coming)
    CHECK(x.take());
  CHECK(function->steps.size() == 3);
}

TEST_CASE_FIXTURE(pooled_world,
                  "what a function computes at once is known when "
                  "it begins; what gives nothing is not delivered, "
                  "and has taken its time if that was seen late") {
  take(lifecycle_step::configure);
  take(lifecycle_step::activate);
  feed(1);
  CHECK(pool->begun == 0);
  CHECK(known.size() == 1);
  CHECK(finished == 1);
  feed(0);
  CHECK(finished == 2);
  REQUIRE(coming.size() == 1);
  CHECK(!coming[0].take());
}

TEST_CASE_FIXTURE(pooled_world, "a function dies with its cycle, also when "
                                "nobody has computed its last one") {
  const std::weak_ptr alive = function;
  take(lifecycle_step::configure);
  take(lifecycle_step::activate);
  feed(2);
  REQUIRE(coming.size() == 1);
  SUBCASE("that ends in good order") {
    take(lifecycle_step::shut_down);
    CHECK(function->steps.size() == 1);
  }
  SUBCASE("that does not") {}
  function.reset();
  cycle.reset();
  CHECK(alive.expired());
}
