// The best assignment, with a proof.
#include "policies/algorithms/assignment/branch_and_bound.hpp"

#include "policies/algorithms/assignment/greedy_regret.hpp"
#include "policies/algorithms/assignment/lagrangian_bound.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace sofof::policies::assignment {

namespace {

struct option {
  choice taken;
  double advantage = 0;
  double margin = 0;
};

/// A vehicle's options, the greatest margin first.
struct decision {
  int vehicle = 0;
  std::vector<option> options;

  double margin() const { return options.front().margin; }
  /// What is lost at least unless the first option is taken.
  double clarity() const {
    return options.size() < 2 ? std::numeric_limits<double>::infinity()
                              : margin() - options[1].margin;
  }
};

/// @returns by index whether anybody leans on a vehicle.
std::vector<bool> leaned_on(const problem& p) {
  std::vector<bool> all(p.vehicles());
  for (const auto& on : p.leans_on)
    if (on)
      all[*on] = true;
  return all;
}

/// @param supports  Whether others lean on it: then a provider may be worth a
///                  loss.
decision decision_of(const problem& p, const reduced_problem& s,
                     const Eigen::ArrayXXd& prices, int vehicle,
                     bool supports) {
  decision result{vehicle, {option{}}};
  const free_capacity empty{s.shares, s.providers()};
  for (int i = 0; i < s.providers(); ++i)
    if (const auto a = s.advantage(vehicle, i); a > 0) {
      result.options.push_back({i, a, margin(s, prices, vehicle, i)});
    } else if (supports && p.eligible(vehicle, i) && empty.fits(vehicle, i)) {
      const auto loss = worth(p, vehicle, i) - worth(p, vehicle, local);
      result.options.push_back({i, loss, loss + margin(s, prices, vehicle, i)});
    }
  std::stable_sort(
      result.options.begin(), result.options.end(),
      [](const option& a, const option& b) { return a.margin > b.margin; });
  return result;
}

/// @returns all decisions, the clearest first, but none before that about whom
/// it leans on.
std::vector<decision> decisions_of(const problem& p, const reduced_problem& s,
                                   const Eigen::ArrayXXd& prices) {
  const auto supports = leaned_on(p);
  std::vector<decision> result;
  for (int v = 0; v < s.vehicles(); ++v)
    result.push_back(decision_of(p, s, prices, v, supports[v]));
  std::stable_sort(result.begin(), result.end(),
                   [](const decision& a, const decision& b) {
                     return a.clarity() > b.clarity();
                   });
  if (p.leans_on.empty())
    return result;
  std::vector<int> order;
  for (const auto& d : result)
    order.push_back(d.vehicle);
  std::vector<decision> sorted;
  for (const auto v : leaning_last(p, order))
    sorted.push_back(*std::ranges::find(result, v, &decision::vehicle));
  return sorted;
}

/// What decisions still to be made can come to, whatever they are.
struct outlook {
  /// Sum of the greatest margins.
  double margins = 0;
  /// Providers × resources: the least share that anybody may want, and what all
  /// may want together.
  Eigen::ArrayXXd least;
  Eigen::ArrayXXd total;

  /// @returns the most that they add; only as much room has a worth as can be
  /// filled.
  double bound(const Eigen::ArrayXXd& prices, const free_capacity& left) const {
    const auto& free = left.free();
    return margins + (prices * (free < least).select(0, free.min(total))).sum();
  }
};

/// @returns the outlook before each decision, and the one after the last.
std::vector<outlook> outlooks(const reduced_problem& s,
                              const std::vector<decision>& decisions) {
  constexpr auto nobody = std::numeric_limits<double>::infinity();
  std::vector<outlook> result(
      decisions.size() + 1,
      {0, Eigen::ArrayXXd::Constant(s.providers(), s.resources(), nobody),
       Eigen::ArrayXXd::Zero(s.providers(), s.resources())});
  for (auto d = decisions.size(); d-- > 0;) {
    auto& o = result[d] = result[d + 1];
    o.margins += decisions[d].margin();
    for (const auto& option : decisions[d].options)
      for (int k = 0; option.taken && k < s.resources(); ++k) {
        const auto share = s.shares[k](decisions[d].vehicle, *option.taken);
        auto& least = o.least(*option.taken, k);
        least = std::min(least, share);
        o.total(*option.taken, k) += share;
      }
  }
  return result;
}

class search {
public:
  /// @param reached  Only what has advantages of a greater sum is looked for.
  search(const problem& p, const reduced_problem& s,
         const Eigen::ArrayXXd& prices, double reached,
         std::int64_t node_limit);

  void run() { visit(0, 0); }

  /// @returns the best choices, or none when nothing greater was found.
  const std::vector<choice>& best() const { return best_; }
  bool gave_up() const { return gave_up_; }
  std::int64_t nodes() const { return nodes_; }

private:
  /// Tries all that can follow from the first decisions, `depth` of them made.
  void visit(int depth, double reached);
  void keep(double reached);

  const problem& whole_;
  const reduced_problem& problem_;
  const Eigen::ArrayXXd& prices_;
  std::vector<decision> decisions_;
  std::vector<outlook> outlooks_;
  /// Before each decision, so that nothing need be undone.
  std::vector<free_capacity> rooms_;
  std::vector<choice> choices_;
  std::vector<choice> best_;
  double best_reached_;
  std::int64_t nodes_ = 0;
  std::int64_t node_limit_;
  bool gave_up_ = false;
};

search::search(const problem& p, const reduced_problem& s,
               const Eigen::ArrayXXd& prices, double reached,
               std::int64_t node_limit)
    : whole_{p}, problem_{s}, prices_{prices},
      decisions_{decisions_of(p, s, prices)}, outlooks_{outlooks(s,
                                                                 decisions_)},
      rooms_(s.vehicles() + 1, free_capacity{s.shares, s.providers()}),
      choices_(s.vehicles()), best_reached_{reached}, node_limit_{node_limit} {}

void search::keep(double reached) {
  if (reached <= best_reached_)
    return;
  best_reached_ = reached;
  best_ = choices_;
}

void search::visit(int depth, double reached) {
  if (nodes_ >= node_limit_) {
    gave_up_ = true;
    return;
  }
  ++nodes_;
  if (depth == problem_.vehicles())
    return keep(reached);
  const auto& d = decisions_[depth];
  const auto& before = rooms_[depth];
  const auto most = reached + outlooks_[depth].bound(prices_, before);
  for (const auto& o : d.options) {
    if (most - d.margin() + o.margin <= best_reached_ + problem_.rounding)
      return;
    if (o.taken && !before.fits(d.vehicle, *o.taken))
      continue;
    rooms_[depth + 1] = before;
    if (o.taken)
      rooms_[depth + 1].occupy(d.vehicle, *o.taken);
    choices_[d.vehicle] = o.taken;
    visit(depth + 1, reached + o.advantage
                         - loss_alone(whole_, choices_, d.vehicle, o.taken));
  }
}

} // namespace

proved_solution branch_and_bound(const problem& p, std::int64_t node_limit) {
  assert(node_limit >= 0);
  const auto s = stakes_of(p);
  auto best = greedy_regret(p);
  const auto reached = best.value - s.all_local;
  const auto priced = price_capacities(s, reached);
  search all{p, s, priced.prices, reached, node_limit};
  all.run();
  if (!all.best().empty())
    best = {all.best(), value(p, all.best())};
  const auto proved = !all.gave_up();
  const auto bound = proved ? best.value : s.all_local + priced.bound;
  return {best, proved, bound, all.nodes()};
}

} // namespace sofof::policies::assignment
