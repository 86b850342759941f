// Assignment problems to try, and their optima by plainer means.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"
#include "tests/support/dice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sofof::test {

/// A problem without resources in which everybody is local and may go anywhere,
/// for nothing.
inline policies::assignment::problem open_problem(int vehicles, int providers) {
  return {policies::assignment::pair_table::Zero(vehicles, providers),
          policies::assignment::pair_flags::Constant(vehicles, providers, true),
          {},
          std::vector<policies::assignment::choice>(
              vehicles, policies::assignment::local),
          0};
}

inline int below(dice& random, int end) {
  return static_cast<int>(random.between(0, end));
}

inline policies::assignment::pair_table table_between(dice& random,
                                                      int vehicles,
                                                      int providers, double low,
                                                      double high) {
  policies::assignment::pair_table result(vehicles, providers);
  for (auto& number : result.reshaped<Eigen::RowMajor>())
    number = random.between(low, high);
  return result;
}

/// Demands of vehicles that are the same everywhere, and equal capacities for a
/// share of all of them.
inline policies::assignment::resource scarce(dice& random, int vehicles,
                                             int providers, double share) {
  const auto demand = table_between(random, vehicles, 1, 0.1, 0.5);
  return {demand.replicate(1, providers),
          std::vector<double>(providers, share * demand.sum() / providers)};
}

/// Half of the vehicles, chosen at random, are with some provider now.
inline void place_at_random(policies::assignment::problem& p, dice& random) {
  for (auto& c : p.present)
    if (random.between(0, 1) < 0.5)
      c = below(random, p.providers());
}

/// A problem with up to 8 vehicles, 3 providers and 2 resources that has what
/// may occur: gains below zero, pairs that are not eligible, decimals that fill
/// a capacity exactly, capacities of nothing and without end.
inline policies::assignment::problem any_problem(dice& random) {
  const auto vehicles = 8 - below(random, 4) * below(random, 3);
  const auto providers = 1 + below(random, 3);
  auto p = open_problem(vehicles, providers);
  p.gains = table_between(random, vehicles, providers, -0.1, 1);
  p.eligible = table_between(random, vehicles, providers, 0, 1)
               < random.between(0.5, 1.5);
  p.switching_price = below(random, 3) * random.between(0, 0.3);
  place_at_random(p, random);
  const auto resources = below(random, 8) == 0 ? 0 : 1 + below(random, 2);
  for (int k = 0; k < resources; ++k) {
    auto r = scarce(random, vehicles, providers, random.between(0.3, 0.8));
    if (below(random, 2) == 0)
      r.demand = table_between(random, vehicles, providers, 0, 5).floor() / 10;
    for (auto& capacity : r.capacity)
      capacity = std::ceil(10 * capacity) / 10;
    if (below(random, 8) == 0)
      r.capacity.front() = 0;
    if (below(random, 8) == 0)
      r.capacity.back() = std::numeric_limits<double>::infinity();
    p.resources.push_back(r);
  }
  return p;
}

/// The objective of one vehicle, as its formula is written.
inline double objective(const policies::assignment::problem& p, int vehicle,
                        policies::assignment::choice c) {
  double sum = 0;
  for (int i = 0; i < p.providers(); ++i) {
    const double x = c == i ? 1 : 0;
    const double present = p.present[vehicle] == i ? 1 : 0;
    const auto changes = present * (1 - x) + (1 - present) * x;
    sum += (x > 0 ? p.gains(vehicle, i) : 0) - p.switching_price * changes;
  }
  return sum;
}

/// @returns the greatest objective of vehicles from one on; tries everything.
inline double best_by_trying(policies::assignment::problem& p,
                             int vehicle = 0) {
  if (vehicle == p.vehicles())
    return 0;
  auto best = objective(p, vehicle, policies::assignment::local)
              + best_by_trying(p, vehicle + 1);
  for (int i = 0; i < p.providers(); ++i) {
    if (!p.eligible(vehicle, i))
      continue;
    auto fits = true;
    for (const auto& r : p.resources)
      fits &= r.demand(vehicle, i) <= r.capacity[i] + 1e-9;
    if (!fits)
      continue;
    for (auto& r : p.resources)
      r.capacity[i] -= r.demand(vehicle, i);
    best = std::max(best,
                    objective(p, vehicle, i) + best_by_trying(p, vehicle + 1));
    for (auto& r : p.resources)
      r.capacity[i] += r.demand(vehicle, i);
  }
  return best;
}

/// @returns the greatest objective for one resource of whole numbers at three
/// providers of one capacity, by dynamic programming over what is free.
inline double best_by_tables(const policies::assignment::problem& p) {
  const auto& r = p.resources.front();
  const auto sizes = static_cast<int>(r.capacity.front()) + 1;
  const int strides[] = {1, sizes, sizes * sizes};
  std::vector<double> best(sizes * sizes * sizes);
  for (int v = p.vehicles() - 1; v >= 0; --v) {
    std::vector<double> with(best);
    for (auto& b : with)
      b += objective(p, v, policies::assignment::local);
    for (int i = 0; i < 3; ++i) {
      const auto wanted = static_cast<int>(r.demand(v, i));
      const auto won = objective(p, v, i);
      for (int state = 0; state < static_cast<int>(best.size()); ++state)
        if (state / strides[i] % sizes >= wanted)
          with[state] =
              std::max(with[state], won + best[state - wanted * strides[i]]);
    }
    best = std::move(with);
  }
  return best.back();
}

} // namespace sofof::test
