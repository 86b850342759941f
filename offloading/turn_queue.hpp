// How parts that know nothing of each other talk without waiting.
#pragma once

#include "base/time.hpp"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace sofof::offloading {

/// Runs turns: what a part is told in one turn it handles in a later one, in
/// the order in which it was told. Parts with something to handle take turns in
/// the order in which they came to have it, one message each, as actors in a
/// run with one worker do.
class turn_queue {
public:
  using turn = std::function<void(time_point now)>;

  /// What one part is still to handle.
  class mailbox {
    friend class turn_queue;
    std::deque<turn> turns_;
  };
  using part = std::shared_ptr<mailbox>;

  static part make_part() { return std::make_shared<mailbox>(); }

  /// @param to  Not null.
  void post(const part& to, turn what) {
    to->turns_.push_back(std::move(what));
    if (to->turns_.size() == 1)
      ready_.push_back(to);
  }

  /// A turn that is posted when `wake` is called with the returned number.
  std::uint64_t post_later(const part& to, turn what) {
    later_.emplace(++last_, std::pair{to, std::move(what)});
    return last_;
  }

  /// Posts that turn, once; a number that is not known is ignored.
  void wake(std::uint64_t number) {
    if (auto due = later_.extract(number); !due.empty())
      post(due.mapped().first, std::move(due.mapped().second));
  }

  /// Runs until nobody has anything to handle. A turn may post, but not run.
  void run(time_point now) {
    while (!ready_.empty()) {
      const auto next = std::move(ready_.front());
      ready_.pop_front();
      const auto what = std::move(next->turns_.front());
      what(now); // while it is the first, what is posted here does not wake it
      next->turns_.pop_front();
      if (!next->turns_.empty())
        ready_.push_back(next);
    }
  }

private:
  std::deque<part> ready_;
  std::map<std::uint64_t, std::pair<part, turn>> later_;
  std::uint64_t last_ = 0;
};

} // namespace sofof::offloading
