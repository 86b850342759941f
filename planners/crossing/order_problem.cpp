// What comes of an order.
#include "planners/crossing/order_problem.hpp"

#include <cassert>
#include <numeric>

namespace sofof::planners {

crossing_schedule timed(const order_problem& problem,
                        std::span<const std::size_t> order) {
  assert(order.size() == problem.size());
  crossing_schedule result;
  result.order.assign(order.begin(), order.end());
  result.at_s.resize(problem.size());
  result.cost = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto who = order[i];
    auto at_s = problem.cars()[who].earliest_s;
    for (const auto before : order.first(i))
      at_s = std::max(at_s, result.at_s[before] + problem.lag_s(before, who));
    result.at_s[who] = problem.open_s(who, at_s);
    result.cost += problem.cost(who, result.at_s[who]);
  }
  assert(result.cost >= 0);
  return result;
}

std::vector<std::size_t> order_of_arrival(const order_problem& problem) {
  const auto& cars = problem.cars();
  // A car arrives no earlier than those before it in its lane.
  std::vector<double> latest_s(cars.size(), order_problem::never_meet);
  std::vector<double> arrives_s;
  for (const auto& x : cars) {
    assert(x.lane < cars.size());
    latest_s[x.lane] = std::max(latest_s[x.lane], x.wish_s);
    arrives_s.push_back(latest_s[x.lane]);
  }
  std::vector<std::size_t> order(cars.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](auto i) { return arrives_s[i]; });
  assert(order.size() == cars.size());
  return order;
}

} // namespace sofof::planners
