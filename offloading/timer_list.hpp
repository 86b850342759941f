// What a part waits for, by the numbers of its timers.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::offloading {

/// Numbers timers, and remembers of each what it is for until its time has
/// come. A number is never given twice.
/// @tparam T  What a timer is for; best a small one.
template <class T>
class timer_list {
public:
  /// @returns the number of a new timer.
  std::uint64_t add(T what) {
    timers_.push_back({++last_, std::move(what)});
    return last_;
  }

  /// @param number  That has been given.
  /// @returns what this timer was for, once.
  std::optional<T> claim(std::uint64_t number) {
    assert(number <= last_);
    const auto i =
        std::ranges::lower_bound(timers_, number, {}, &timer::number);
    if (i == timers_.end() || i->number != number)
      return std::nullopt;
    std::optional<T> what{std::move(i->what)};
    timers_.erase(i);
    return what;
  }

  std::size_t size() const { return timers_.size(); }

private:
  struct timer {
    std::uint64_t number = 0;
    T what;
  };

  std::vector<timer> timers_; // numbers rise
  std::uint64_t last_ = 0;
};

} // namespace sofof::offloading
