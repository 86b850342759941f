// Helpers take jobs in the order in which they were begun.
#include "base/job_pool.hpp"

#include <cassert>
#include <system_error>
#include <utility>

namespace sofof {

namespace {

/// A helper that sleeps is woken for so many jobs at once: to wake it takes as
/// long as a short one of them.
constexpr std::size_t worth_waking = 8;

} // namespace

void job::run() {
  auto waits = state::waits;
  if (!state_.compare_exchange_strong(waits, state::runs,
                                      std::memory_order_acquire))
    return;
  try {
    what_();
  } catch (...) {
    thrown_ = std::current_exception();
  }
  what_ = nullptr; // and all that it holds
  state_.store(state::done, std::memory_order_release);
  state_.notify_all();
}

void job::wait() {
  run();
  state_.wait(state::runs, std::memory_order_acquire);
  assert(state_ == state::done);
  if (thrown_)
    std::rethrow_exception(thrown_);
}

job_pool::job_pool(std::size_t helpers) {
  helpers_.reserve(helpers);
  try {
    for (std::size_t k = 0; k < helpers; ++k)
      helpers_.emplace_back([this] { help(); });
  } catch (const std::system_error&) {
    return; // the machine gives no more: those that there are do
  }
}

job_pool::~job_pool() {
  {
    const std::lock_guard lock{mutex_};
    ends_ = true;
  }
  more_.notify_all();
  for (auto& thread : helpers_)
    thread.join();
}

void job_pool::begin(job_ptr what) {
  assert(what);
  if (helpers_.empty())
    return what->run();
  auto many = false;
  {
    const std::lock_guard lock{mutex_};
    waiting_.push_back(std::move(what));
    many = waiting_.size() >= worth_waking;
  }
  if (many)
    more_.notify_one();
}

void job_pool::help() {
  std::unique_lock lock{mutex_};
  for (;;) {
    more_.wait(lock,
               [this] { return ends_ || waiting_.size() >= worth_waking; });
    if (ends_)
      return;
    while (!waiting_.empty() && !ends_) {
      const auto next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      next->run();
      lock.lock();
    }
  }
}

} // namespace sofof
