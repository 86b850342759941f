// An assignment problem in the terms that its solvers reckon in: advantages
// over local computing, and shares of a capacity.
#include "policies/algorithms/assignment/reduced_problem.hpp"

#include <algorithm>
#include <limits>

namespace sofof::policies::assignment {

namespace {

/// A provider is full to within this share of its capacity.
constexpr double tolerance = 1e-9;

double share(double demand, double capacity) {
  if (demand == 0)
    return 0;
  return capacity > 0 ? demand / capacity
                      : std::numeric_limits<double>::infinity();
}

} // namespace

std::vector<pair_table> shares_of(const problem& p) {
  std::vector<pair_table> result;
  for (const auto& r : p.resources) {
    pair_table shares = pair_table::Zero(p.vehicles(), p.providers());
    for (int v = 0; v < p.vehicles(); ++v)
      for (int i = 0; i < p.providers(); ++i)
        if (p.eligible(v, i))
          shares(v, i) = share(r.demand(v, i), r.capacity[i]);
    result.push_back(std::move(shares));
  }
  return result;
}

free_capacity::free_capacity(const std::vector<pair_table>& shares,
                             int providers)
    : shares_{&shares}, free_{Eigen::ArrayXXd::Constant(
                            providers, static_cast<Eigen::Index>(shares.size()),
                            1 + tolerance)} {}

bool free_capacity::fits(int vehicle, int provider) const {
  for (std::size_t k = 0; k < shares_->size(); ++k)
    if ((*shares_)[k](vehicle, provider) > free_(provider, static_cast<int>(k)))
      return false;
  return true;
}

void free_capacity::occupy(int vehicle, int provider) {
  for (std::size_t k = 0; k < shares_->size(); ++k)
    free_(provider, static_cast<int>(k)) -= (*shares_)[k](vehicle, provider);
}

void free_capacity::give_back(int vehicle, int provider) {
  for (std::size_t k = 0; k < shares_->size(); ++k)
    free_(provider, static_cast<int>(k)) += (*shares_)[k](vehicle, provider);
}

reduced_problem stakes_of(const problem& p) {
  check(p);
  reduced_problem result{pair_table::Zero(p.vehicles(), p.providers()),
                         shares_of(p),
                         value(p, std::vector<choice>(p.vehicles(), local)), 0};
  const free_capacity empty{result.shares, p.providers()};
  for (int v = 0; v < p.vehicles(); ++v)
    for (int i = 0; i < p.providers(); ++i)
      if (p.eligible(v, i) && empty.fits(v, i))
        result.advantage(v, i) =
            std::max(0.0, worth(p, v, i) - worth(p, v, local));
  if (result.advantage.size() > 0)
    result.rounding = 1e-9 * result.advantage.maxCoeff();
  return result;
}

} // namespace sofof::policies::assignment
