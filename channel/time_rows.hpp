// Sums by time, however long that is, in little room.
#pragma once

#include "base/time.hpp"

#include <cassert>
#include <chrono>
#include <cstddef>
#include <vector>

namespace sofof::channel {

/// In rows of a second, and of 2, 4, 8 … s where that were more than 1801: half
/// an hour is told by the second, its last moment too, and a day by the minute.
/// @returns how long a row is, for a time since the start >= 0.
constexpr duration length_of_rows(duration until) {
  constexpr std::size_t most = 1800;
  auto length = duration{std::chrono::seconds{1}};
  while (until / length > static_cast<duration::rep>(most))
    length *= 2;
  return length;
}

/// @tparam Sum  What is added up; its default is nothing.
template <class Sum>
class time_rows {
public:
  /// @param t  Since the start, >= 0.
  /// @returns the sum of the row that this is in.
  Sum& at(duration t) {
    assert(t >= duration{0});
    join_to(length_of_rows(t));
    const auto k = static_cast<std::size_t>(t / length_);
    if (k >= sums_.size())
      sums_.resize(k + 1);
    return sums_[k];
  }

  /// @returns how long a row is.
  duration length() const { return length_; }

  const std::vector<Sum>& sums() const { return sums_; }

  /// Makes rows at least so long.
  void join_to(duration length) {
    while (length_ < length)
      join();
  }

private:
  void join() { // rows twice as long
    for (std::size_t k = 0; k < sums_.size(); ++k)
      if (k % 2 == 0)
        sums_[k / 2] = sums_[k];
      else
        sums_[k / 2] += sums_[k];
    sums_.resize((sums_.size() + 1) / 2);
    length_ *= 2;
  }

  duration length_ = std::chrono::seconds{1};
  std::vector<Sum> sums_;
};

} // namespace sofof::channel
