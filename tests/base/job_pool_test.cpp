// Tests of jobs that several threads compute.
#include "base/job_pool.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace sofof;

TEST_CASE("a job is computed once, whoever asks and how often") {
  for (const std::size_t helpers : {0, 1, 3}) {
    CAPTURE(helpers);
    constexpr std::size_t count = 2000;
    std::vector<std::atomic<int>> computed(count);
    job_pool pool{helpers};
    std::vector<job_ptr> jobs;
    for (std::size_t k = 0; k < count; ++k) {
      jobs.push_back(std::make_shared<job>([&computed, k] { ++computed[k]; }));
      pool.begin(jobs.back());
      if (k >= 20)
        jobs[k - 20]->wait();
    }
    for (auto k = count; k-- > 0;) {
      jobs[k]->wait();
      jobs[k]->wait();
    }
    for (const auto& times : computed)
      CHECK(times == 1);
  }
}

TEST_CASE("what a job has computed is seen by who has waited for it") {
  job_pool pool{2};
  for (auto k = 0; k < 1000; ++k) {
    auto made = std::make_shared<std::vector<int>>();
    std::vector<job_ptr> jobs;
    for (auto i = 0; i < 8; ++i) {
      jobs.push_back(std::make_shared<job>(
          [made, i, last = i > 0 ? jobs.back() : job_ptr{}] {
            if (last)
              last->wait();
            made->push_back(i);
          }));
      pool.begin(jobs.back());
    }
    jobs.back()->wait();
    CHECK(*made == std::vector{0, 1, 2, 3, 4, 5, 6, 7});
  }
}

TEST_CASE("helpers compute while who has begun the jobs does something else") {
  job_pool pool{1};
  std::atomic<bool> by_another = false;
  const auto me = std::this_thread::get_id();
  std::vector<job_ptr> jobs;
  for (auto k = 0; k < 100; ++k) {
    jobs.push_back(std::make_shared<job>([&by_another, me] {
      by_another = by_another || std::this_thread::get_id() != me;
    }));
    pool.begin(jobs.back());
  }
  while (!by_another)
    std::this_thread::yield();
  for (const auto& x : jobs)
    x->wait();
}

TEST_CASE("what a job throws is thrown to who waits") {
  for (const std::size_t helpers : {0, 2}) {
    job_pool pool{helpers};
    for (auto k = 0; k < 20; ++k) {
      const auto bad = std::make_shared<job>(
          [] { throw std::runtime_error{"no solution"}; });
      pool.begin(bad);
      CHECK_THROWS_WITH(bad->wait(), "no solution");
    }
  }
}

TEST_CASE("a pool ends with jobs that nobody has computed; they can be yet") {
  std::vector<job_ptr> jobs;
  std::atomic<int> computed = 0;
  {
    job_pool pool{2};
    for (auto k = 0; k < 100; ++k) {
      jobs.push_back(std::make_shared<job>([&computed] { ++computed; }));
      pool.begin(jobs.back());
    }
  }
  for (const auto& x : jobs)
    x->wait();
  CHECK(computed == 100);
}
