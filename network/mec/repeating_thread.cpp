// A thread that asks a registry now and then.
#include "network/mec/repeating_thread.hpp"

#include "network/block_signals.hpp"
#include "network/deadline.hpp"

#include <utility>

namespace sofof::network::mec011 {

repeating_thread::repeating_thread(std::function<pause_between()> step,
                                   std::function<void()> at_end)
    : step_{std::move(step)}, at_end_{std::move(at_end)}, thread_{[this] {
        run();
      }} {}

repeating_thread::~repeating_thread() {
  stop();
}

void repeating_thread::hurry() {
  {
    const std::lock_guard lock{mutex_};
    is_in_a_hurry_ = true;
  }
  changed_.notify_all();
}

void repeating_thread::end() {
  {
    const std::lock_guard lock{mutex_};
    ends_ = true;
  }
  changed_.notify_all();
}

void repeating_thread::stop() {
  end();
  if (thread_.joinable())
    thread_.join();
}

void repeating_thread::run() {
  leave_signals_to_others();
  std::unique_lock lock{mutex_};
  while (!ends_) {
    is_in_a_hurry_ = false;
    lock.unlock();
    const auto pause = step_();
    const auto now = deadline_clock::now();
    lock.lock();
    changed_.wait_until(lock, now + pause.at_least, [this] { return ends_; });
    changed_.wait_until(lock, now + pause.at_most,
                        [this] { return ends_ || is_in_a_hurry_; });
  }
  lock.unlock();
  at_end_();
}

} // namespace sofof::network::mec011
