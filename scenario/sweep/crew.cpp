// The hands of a worker.
#include "scenario/sweep/crew.hpp"

#include <exception>
#include <system_error>
#include <utility>

namespace sofof {

namespace fs = std::filesystem;

run_order::run_order(fs::path folder) : folder_{std::move(folder)} {
  fs::create_directory(folder_);
  fs::create_directory(given());
}

run_order::~run_order() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void run_order::end(std::string failure) {
  const std::lock_guard lock{mutex_};
  ended_ = std::move(failure);
}

std::optional<std::string> run_order::ended() const {
  const std::lock_guard lock{mutex_};
  return ended_;
}

crew::crew(std::size_t hands, order_runner run) : run_{std::move(run)} {
  for (std::size_t i = 0; i < hands; ++i)
    hands_.emplace_back([this] { work(); });
}

void crew::add(std::shared_ptr<run_order> order, std::function<void()> on_end) {
  const std::lock_guard lock{mutex_};
  if (stops_)
    return;
  waiting_.push_back({std::move(order), std::move(on_end)});
  changed_.notify_one();
}

void crew::stop() {
  std::deque<job> forgotten;
  {
    const std::lock_guard lock{mutex_};
    stops_ = true;
    forgotten.swap(waiting_);
    for (auto* order : at_work_)
      order->interrupted = true;
    changed_.notify_all();
  }
  for (auto& hand : hands_)
    hand.join();
  hands_.clear();
}

void crew::work() {
  std::unique_lock lock{mutex_};
  for (;;) {
    changed_.wait(lock, [this] { return stops_ || !waiting_.empty(); });
    if (stops_)
      return;
    auto next = std::move(waiting_.front());
    waiting_.pop_front();
    at_work_.insert(next.order.get());
    lock.unlock();
    carry_out(next);
    lock.lock();
    at_work_.erase(next.order.get());
    lock.unlock();
    next = {}; // its folder may go now
    lock.lock();
  }
}

void crew::carry_out(const job& next) const {
  auto& order = *next.order;
  if (order.interrupted) // while it waited
    return;
  std::string failure;
  try {
    run_(order);
  } catch (const std::exception& problem) {
    failure = problem.what();
  }
  if (order.interrupted)
    return; // nobody wants to know, or another worker does it
  order.end(std::move(failure));
  next.on_end();
}

} // namespace sofof
