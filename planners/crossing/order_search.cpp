// Branch and bound with dominance.
#include "planners/crossing/order_search.hpp"

#include <bit>
#include <cassert>
#include <tuple>

namespace sofof::planners {
namespace {

/// Costs and times that differ by less are the same, s.
constexpr double same_s = 1e-9;
/// A schedule is better only by more than this.
constexpr double worth_s = 1e-6;

std::uint64_t hash(std::span<const std::size_t> heads) {
  std::uint64_t sum = 0;
  for (const auto head : heads)
    sum = (sum ^ head) * 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
  return sum ^ sum >> 32;
}

} // namespace

const crossing_schedule&
order_search::solve(const order_problem& problem,
                    std::span<const std::size_t> first) {
  prepare(problem);
  best_ = timed(problem, first);
  if (problem.size() > 0)
    visit(0, 0);
  best_.is_best = !is_out_of_nodes_;
  assert(best_.order.size() == problem.size() && order_.empty());
  return best_;
}

void order_search::prepare(const order_problem& problem) {
  problem_ = &problem;
  const auto count = problem.size();
  lanes_.resize(std::max(lanes_.size(), count));
  for (auto& lane : lanes_)
    lane.clear();
  for (std::size_t i = 0; i < count; ++i)
    lanes_[problem.cars()[i].lane].push_back(i);
  assert(lanes_.size() >= count);
  heads_.assign(lanes_.size(), 0);
  levels_.resize(std::max(levels_.size(), count + 1));
  for (auto& x : levels_)
    x.entry_s.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    levels_[0].entry_s[i] = problem.open_s(i, problem.cars()[i].earliest_s);
  order_.clear();
  at_s_.assign(count, 0);
  nodes_ = 0;
  is_out_of_nodes_ = false;
  labels_.clear();
  label_entry_s_.clear();
  label_heads_.clear();
  buckets_.assign(std::bit_ceil(most_.labels + 1), no_label);
  assert(std::has_single_bit(buckets_.size()));
}

/// @param cost  Of those that have gone.
void order_search::visit(std::size_t depth, double cost) {
  assert(depth == order_.size());
  if (depth == problem_->size()) {
    assert(cost < best_.cost);
    best_.order = order_;
    best_.at_s = at_s_;
    best_.cost = cost;
    return;
  }
  auto& here = levels_[depth];
  list_children(depth, cost);
  for (const auto& x : here.children) {
    if (is_out_of_nodes_ || x.low >= best_.cost - worth_s)
      return;
    const auto at_s = here.entry_s[x.who];
    const auto entry_s =
        std::span{here.child_entry_s}.subspan(x.entries, problem_->size());
    const auto sum = cost + problem_->cost(x.who, at_s);
    ++heads_[x.lane];
    if (is_new(entry_s, sum)) {
      std::ranges::copy(entry_s, levels_[depth + 1].entry_s.begin());
      order_.push_back(x.who);
      at_s_[x.who] = at_s;
      visit(depth + 1, sum);
      order_.pop_back();
    }
    assert(heads_[x.lane] > 0);
    --heads_[x.lane];
  }
}

/// The most promising first; only one where it holds up nobody else.
void order_search::list_children(std::size_t depth, double cost) {
  auto& here = levels_[depth];
  here.children.clear();
  here.child_entry_s.clear();
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    if (heads_[lane] == lanes_[lane].size())
      continue;
    if (nodes_ == most_.nodes) {
      is_out_of_nodes_ = true;
      return;
    }
    ++nodes_;
    const auto who = lanes_[lane][heads_[lane]];
    const auto entries = here.child_entry_s.size();
    const auto is_harmless = go(lane, here);
    const auto entry_s = std::span{here.child_entry_s}.subspan(entries);
    ++heads_[lane];
    const child x{who, lane,
                  cost + problem_->cost(who, here.entry_s[who])
                      + bound(entry_s),
                  entries};
    --heads_[lane];
    assert(x.low >= cost - same_s);
    if (is_harmless) {
      here.children.assign(1, x);
      return;
    }
    here.children.push_back(x);
  }
  std::ranges::sort(here.children, {}, [&](const child& x) {
    return std::tuple{x.low, here.entry_s[x.who], x.who};
  });
  assert(!here.children.empty());
}

/// Appends when the others may enter once the first car of a lane has gone.
/// @returns whether it holds up nobody of another lane.
bool order_search::go(std::size_t lane, level& here) {
  const auto who = lanes_[lane][heads_[lane]];
  assert(who < here.entry_s.size());
  const auto at_s = here.entry_s[who];
  const auto begin = here.child_entry_s.size();
  here.child_entry_s.insert(here.child_entry_s.end(), here.entry_s.begin(),
                            here.entry_s.end());
  auto is_harmless = true;
  for (std::size_t other = 0; other < lanes_.size(); ++other)
    for (auto k = heads_[other]; k < lanes_[other].size(); ++k) {
      const auto i = lanes_[other][k];
      auto& entry_s = here.child_entry_s[begin + i];
      const auto least_s =
          at_s
          + (i == who ? order_problem::never_meet : problem_->lag_s(who, i));
      if (least_s <= entry_s + same_s)
        continue;
      entry_s = problem_->open_s(i, least_s);
      is_harmless = is_harmless && other == lane;
    }
  assert(here.child_entry_s.size() == begin + problem_->size());
  return is_harmless;
}

double order_search::bound(std::span<const double> entry_s) const {
  assert(entry_s.size() == problem_->size());
  auto sum = 0.0;
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    auto before_s = 0.0;
    for (auto k = heads_[lane]; k < lanes_[lane].size(); ++k) {
      const auto i = lanes_[lane][k];
      auto at_s = entry_s[i];
      if (k > heads_[lane])
        at_s =
            std::max(at_s, before_s + problem_->lag_s(lanes_[lane][k - 1], i));
      sum += problem_->cost(i, at_s);
      before_s = at_s;
    }
  }
  assert(sum >= 0);
  return sum;
}

/// Remembers a state.
/// @returns whether no state before is as good in every respect.
bool order_search::is_new(std::span<const double> entry_s, double cost) {
  assert(cost >= 0 && !buckets_.empty());
  const auto gone = hash(heads_);
  auto& bucket = buckets_[gone & (buckets_.size() - 1)];
  for (auto i = bucket; i != no_label; i = labels_[i].next)
    if (labels_[i].gone == gone && is_no_better(labels_[i], entry_s, cost))
      return false;
  if (labels_.size() == most_.labels)
    return true;
  labels_.push_back(
      {gone, cost, label_entry_s_.size(), label_heads_.size(), bucket});
  bucket = static_cast<std::uint32_t>(labels_.size() - 1);
  label_entry_s_.insert(label_entry_s_.end(), entry_s.begin(), entry_s.end());
  label_heads_.insert(label_heads_.end(), heads_.begin(), heads_.end());
  assert(labels_.size() <= most_.labels);
  return true;
}

bool order_search::is_no_better(const label& x, std::span<const double> entry_s,
                                double cost) const {
  assert(entry_s.size() == problem_->size());
  if (x.cost > cost + same_s
      || !std::equal(heads_.begin(), heads_.end(),
                     label_heads_.begin()
                         + static_cast<std::ptrdiff_t>(x.heads)))
    return false;
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane)
    for (auto k = heads_[lane]; k < lanes_[lane].size(); ++k) {
      const auto i = lanes_[lane][k];
      if (label_entry_s_[x.entries + i] > entry_s[i] + same_s)
        return false;
    }
  assert(x.entries + entry_s.size() <= label_entry_s_.size());
  return true;
}

} // namespace sofof::planners
