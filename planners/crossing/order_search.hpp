// The best order in which cars go over a crossing.
#pragma once

#include "planners/crossing/order_problem.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sofof::planners {

/// Branch and bound over orders: at each node, the first car of some lane goes
/// next.
/// * Bound: what the rest costs if lanes do not hold each other up.
/// * A car that holds up nobody of another lane goes at once.
/// * Dominance: the same cars have gone at no less cost, and none of the others
///   may enter earlier.
///
/// Deterministic: it counts nodes and knows no clock. No heap once it has
/// solved a problem of the size.
class order_search {
public:
  struct limits {
    std::size_t nodes = 10'000; ///< Cars tried as the next one.
    std::size_t labels = 4'096; ///< States kept to rule out others.
  };

  explicit order_search(limits most) : most_{most} {}
  order_search() : order_search(limits{}) {}

  /// @param first  An order that is possible; what is found costs no more.
  /// @returns the best schedule found; `is_best` unless nodes ran out.
  const crossing_schedule& solve(const order_problem& problem,
                                 std::span<const std::size_t> first);

  /// @returns how many nodes the last search took.
  std::size_t nodes() const { return nodes_; }

private:
  /// A car that may go next.
  struct child {
    std::size_t who, lane;
    double low;          // no schedule that begins so costs less
    std::size_t entries; // where those of the others begin
  };
  /// The search at one depth.
  struct level {
    std::vector<double> entry_s; // of each car that has not gone
    std::vector<child> children;
    std::vector<double> child_entry_s; // of all children
  };
  /// A state that was visited.
  struct label {
    std::uint64_t gone; // how many of each lane, hashed
    double cost;
    std::size_t entries, heads; // where they begin
    std::uint32_t next;         // in its bucket
  };
  static constexpr std::uint32_t no_label = 0xffffffff;

  void prepare(const order_problem& problem);
  void visit(std::size_t depth, double cost);
  void list_children(std::size_t depth, double cost);
  bool go(std::size_t lane, level& here);
  double bound(std::span<const double> entry_s) const;
  bool is_new(std::span<const double> entry_s, double cost);
  bool is_no_better(const label& x, std::span<const double> entry_s,
                    double cost) const;

  limits most_;
  const order_problem* problem_ = nullptr;
  std::vector<std::vector<std::size_t>> lanes_; // their cars, in order
  std::vector<std::size_t> heads_; // of each lane, how many have gone
  std::vector<level> levels_;
  std::vector<std::size_t> order_; // of those that have gone
  std::vector<double> at_s_;       // of each car that has gone
  crossing_schedule best_;
  std::size_t nodes_ = 0;
  bool is_out_of_nodes_ = false;
  // Labels in buckets by what has gone.
  std::vector<label> labels_;
  std::vector<double> label_entry_s_;
  std::vector<std::size_t> label_heads_;
  std::vector<std::uint32_t> buckets_;
};

} // namespace sofof::planners
