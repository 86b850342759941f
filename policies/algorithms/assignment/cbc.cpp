// The best assignment by COIN-OR's branch and cut.
#include "policies/algorithms/assignment/cbc.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <coin/Cbc_C_Interface.h>
#include <csignal>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace sofof::policies::assignment {

namespace {

/// CBC is for one thread at a time, and puts a handler of its own for Ctrl-C.
class turn_with_cbc {
public:
  turn_with_cbc() { sigaction(SIGINT, nullptr, &ours_); }
  ~turn_with_cbc() { sigaction(SIGINT, &ours_, nullptr); }

  turn_with_cbc(const turn_with_cbc&) = delete;
  turn_with_cbc& operator=(const turn_with_cbc&) = delete;

private:
  static inline std::mutex one_at_a_time;
  std::lock_guard<std::mutex> alone_{one_at_a_time};
  struct sigaction ours_ {};
};

/// A column: vehicle j served by provider i.
struct pair_column {
  int vehicle;
  int provider;
};

/// Columns, and rows of one kind after the other: vehicles, then the finite
/// capacities.
class program {
public:
  explicit program(const problem& p) : p_{p} {
    for (int j = 0; j < p.vehicles(); ++j)
      add_row(1);
    for (const auto& r : p.resources)
      for (const auto capacity : r.capacity)
        if (std::isfinite(capacity))
          add_row(capacity);
    for (int j = 0; j < p.vehicles(); ++j)
      for (int i = 0; i < p.providers(); ++i)
        if (p.eligible(j, i))
          add_column({j, i});
  }

  /// @returns who serves each vehicle in the optimum, if it is found.
  std::optional<std::vector<choice>> solve(std::int64_t node_limit) const {
    std::vector<choice> choices(static_cast<std::size_t>(p_.vehicles()), local);
    if (columns_.empty())
      return choices;
    const turn_with_cbc turn;
    const std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model{
        Cbc_newModel(), Cbc_deleteModel};
    fill(model.get());
    Cbc_setLogLevel(model.get(), 0);
    const auto nodes = std::to_string(
        std::min<std::int64_t>(node_limit, std::numeric_limits<int>::max()));
    Cbc_setParameter(model.get(), "maxNodes", nodes.c_str());
    Cbc_setParameter(model.get(), "ratioGap", "0");
    Cbc_setParameter(model.get(), "allowableGap", "0");
    Cbc_solve(model.get());
    if (!Cbc_isProvenOptimal(model.get()))
      return std::nullopt;
    const auto* x = Cbc_getColSolution(model.get());
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (x[k] > 0.5)
        choices[static_cast<std::size_t>(columns_[k].vehicle)] =
            columns_[k].provider;
    return choices;
  }

private:
  void add_row(double most) { most_.push_back(most); }

  void add_entry(int row, double value) {
    rows_.push_back(row);
    values_.push_back(value);
  }

  void add_column(const pair_column& c) {
    begins_.push_back(static_cast<CoinBigIndex>(rows_.size()));
    columns_.push_back(c);
    worth_.push_back(worth(p_, c.vehicle, c.provider)
                     - worth(p_, c.vehicle, local));
    add_entry(c.vehicle, 1);
    auto row = p_.vehicles();
    for (const auto& r : p_.resources)
      for (int i = 0; i < p_.providers(); ++i)
        if (std::isfinite(r.capacity[static_cast<std::size_t>(i)])) {
          if (i == c.provider)
            add_entry(row, r.demand(c.vehicle, i));
          ++row;
        }
  }

  void fill(Cbc_Model* model) const {
    auto begins = begins_;
    begins.push_back(static_cast<CoinBigIndex>(rows_.size()));
    const std::vector<double> nothing(columns_.size(), 0);
    const std::vector<double> all(columns_.size(), 1);
    const std::vector<double> least(most_.size(), 0); // nothing is below
    Cbc_loadProblem(model, static_cast<int>(columns_.size()),
                    static_cast<int>(most_.size()), begins.data(), rows_.data(),
                    values_.data(), nothing.data(), all.data(), worth_.data(),
                    least.data(), most_.data());
    Cbc_setObjSense(model, -1); // the most
    for (int k = 0; k < static_cast<int>(columns_.size()); ++k)
      Cbc_setInteger(model, k);
  }

  const problem& p_;
  std::vector<pair_column> columns_;
  std::vector<double> worth_; // of each column
  std::vector<double> most_;  // of each row
  // Entries of the columns, one column after the other.
  std::vector<CoinBigIndex> begins_;
  std::vector<int> rows_;
  std::vector<double> values_;
};

} // namespace

std::optional<solution> cbc(const problem& p, std::int64_t node_limit) {
  assert(node_limit >= 0);
  check(p);
  auto choices = program{p}.solve(node_limit);
  if (!choices || !feasible(p, *choices) || !nobody_is_alone(p, *choices))
    return std::nullopt;
  const auto reached = value(p, *choices);
  return solution{std::move(*choices), reached};
}

} // namespace sofof::policies::assignment
