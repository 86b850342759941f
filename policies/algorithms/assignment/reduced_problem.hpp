// An assignment problem in the terms that its solvers reckon in: advantages
// over local computing, and shares of a capacity.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"

#include <vector>

namespace sofof::policies::assignment {

/// @returns for each resource the share of a provider's capacity that a vehicle
/// takes; 0 of an infinite one, and infinity of nothing.
std::vector<pair_table> shares_of(const problem& p);

/// What is free of each provider's capacities, as shares.
class free_capacity {
public:
  /// All of it is free.
  /// @param shares  Outlives the room.
  free_capacity(const std::vector<pair_table>& shares, int providers);

  bool fits(int vehicle, int provider) const;
  void occupy(int vehicle, int provider);
  void give_back(int vehicle, int provider);

  /// Providers × resources; of an empty provider a little above 1, as sums of
  /// decimals are not exact.
  const Eigen::ArrayXXd& free() const { return free_; }

private:
  const std::vector<pair_table>* shares_;
  Eigen::ArrayXXd free_;
};

/// What there is to win. Only pairs with an advantage above 0 matter: nobody
/// loses by staying local instead of another.
struct reduced_problem {
  /// What a vehicle wins by a provider over being local, switching priced in; 0
  /// where there is nothing to win, or not eligible, or too big even for an
  /// empty provider.
  pair_table advantage;
  std::vector<pair_table> shares;
  /// The objective when everybody is local.
  double all_local = 0;
  /// Differences of value below this are rounding: 1e-9 of the greatest
  /// advantage.
  double rounding = 0;

  int vehicles() const { return static_cast<int>(advantage.rows()); }
  int providers() const { return static_cast<int>(advantage.cols()); }
  int resources() const { return static_cast<int>(shares.size()); }

  double advantage_of(int vehicle, choice c) const {
    return c ? advantage(vehicle, *c) : 0;
  }
};

/// @throws std::invalid_argument as check() does.
reduced_problem stakes_of(const problem& p);

} // namespace sofof::policies::assignment
