// In which order cars go over a crossing: what there is to decide, and what
// comes of an order.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace sofof::planners {

/// Cars that come to a crossing, and for how long each of them keeps each
/// other one out of it. All times are those of a car's centre at its line, in
/// seconds from one moment on.
class order_problem {
public:
  /// A lag between cars that never come near each other.
  static constexpr double never_meet = -std::numeric_limits<double>::infinity();

  /// Somebody else is there: no car may come to its line in between.
  struct closure {
    double from_s = 0, to_s = 0;
  };

  struct car {
    std::size_t lane = 0;  ///< On which it comes; those of one lane keep their
                           ///< order, that of the list.
    double wish_s = 0;     ///< When it would be there without others.
    double earliest_s = 0; ///< When it can be there from now on.
    std::vector<closure> closed; ///< Rising, none within another.
  };

  /// Delay beyond this weighs three times, so that nobody waits for ever, s.
  double patience_s = 15;

  /// @param cars  Each lane's number is below the number of cars.
  explicit order_problem(std::vector<car> cars)
      : cars_{std::move(cars)},
        lags_s_(cars_.size() * cars_.size(), never_meet) {
    assert(std::ranges::all_of(
        cars_, [&](const car& x) { return x.lane < cars_.size(); }));
  }

  std::span<const car> cars() const { return cars_; }
  std::size_t size() const { return cars_.size(); }

  /// @returns how much later than `first` the other one may be at its line, if
  /// it goes after it; may be negative.
  double lag_s(std::size_t first, std::size_t then) const {
    assert(first < size() && then < size());
    return lags_s_[first * size() + then];
  }
  void set_lag(std::size_t first, std::size_t then, double lag_s) {
    assert(first < size() && then < size() && first != then);
    lags_s_[first * size() + then] = lag_s;
  }

  /// @returns what it costs that a car is at its line at that time, >= 0 if
  /// that is not before it wishes to.
  double cost(std::size_t who, double at_s) const {
    assert(who < size());
    const auto delay_s = at_s - cars_[who].wish_s;
    return delay_s + 2 * std::max(0.0, delay_s - patience_s);
  }

  /// @returns the first moment from `at_s` on at which the line is open.
  double open_s(std::size_t who, double at_s) const {
    assert(who < size());
    for (const auto& [from_s, to_s] : cars_[who].closed)
      if (at_s > from_s && at_s < to_s)
        at_s = to_s;
    return at_s;
  }

private:
  std::vector<car> cars_;
  std::vector<double> lags_s_; // of each, row by row, to each other
};

/// Who goes when.
struct crossing_schedule {
  std::vector<std::size_t> order; ///< Cars, the first to go first.
  std::vector<double> at_s;       ///< Of each car, by its number.
  double cost = std::numeric_limits<double>::infinity();
  bool is_best = false; ///< No order costs less: all others were ruled out.
};

/// @param order  Each car once, those of a lane in their order.
/// @returns the earliest times at which the cars can go in this order.
crossing_schedule timed(const order_problem& problem,
                        std::span<const std::size_t> order);

/// @returns the cars as they would arrive alone, those of a lane in their
/// order.
std::vector<std::size_t> order_of_arrival(const order_problem& problem);

} // namespace sofof::planners
