// A good assignment at once: first those who would lose most by waiting.
#include "policies/algorithms/assignment/greedy_regret.hpp"

#include "policies/algorithms/assignment/lagrangian_bound.hpp"

#include <algorithm>

namespace sofof::policies::assignment {

namespace {

pair_table advantage_per_share(const reduced_problem& s) {
  pair_table size = pair_table::Constant(s.vehicles(), s.providers(), 1e-9);
  for (const auto& shares : s.shares)
    size += shares;
  return s.advantage / size;
}

pair_table margins(const reduced_problem& s) {
  const auto prices = price_capacities(s, 0).prices;
  pair_table result = pair_table::Zero(s.vehicles(), s.providers());
  for (int v = 0; v < s.vehicles(); ++v)
    for (int i = 0; i < s.providers(); ++i)
      if (s.advantage(v, i) > 0)
        result(v, i) = std::max(0.0, margin(s, prices, v, i));
  return result;
}

class attempt {
public:
  explicit attempt(const reduced_problem& s)
      : problem_{s}, room_{s.shares, s.providers()},
        choices_(s.vehicles(), local) {}

  /// @param desire  How much a vehicle wants a provider; 0: not at all.
  void serve_by(const pair_table& desire);
  void improve();

  const std::vector<choice>& choices() const { return choices_; }

private:
  struct candidate {
    choice best;
    double regret = 0;
  };
  candidate next_best(int vehicle, const pair_table& desire) const;

  bool allowed(int vehicle, choice c) const {
    return !c
           || (problem_.advantage(vehicle, *c) > 0 && room_.fits(vehicle, *c));
  }
  void leave(int vehicle);
  void enter(int vehicle, choice c);
  bool move(int vehicle, choice c);
  bool exchange(int one, int other);

  const reduced_problem& problem_;
  free_capacity room_;
  std::vector<choice> choices_;
};

attempt::candidate attempt::next_best(int vehicle,
                                      const pair_table& desire) const {
  candidate result;
  double best = 0;
  double second = 0;
  for (int i = 0; i < problem_.providers(); ++i) {
    const auto desired = desire(vehicle, i);
    if (desired <= second || !room_.fits(vehicle, i))
      continue;
    if (desired > best) {
      second = best;
      best = desired;
      result.best = i;
    } else {
      second = desired;
    }
  }
  result.regret = best - second;
  return result;
}

void attempt::serve_by(const pair_table& desire) {
  std::vector<int> waiting(problem_.vehicles());
  for (int v = 0; v < problem_.vehicles(); ++v)
    waiting[v] = v;
  while (!waiting.empty()) {
    auto next = waiting.end();
    candidate most;
    for (auto v = waiting.begin(); v != waiting.end(); ++v) {
      const auto c = next_best(*v, desire);
      if (c.best && (!most.best || c.regret > most.regret)) {
        most = c;
        next = v;
      }
    }
    if (next == waiting.end())
      return;
    enter(*next, most.best);
    waiting.erase(next);
  }
}

void attempt::leave(int vehicle) {
  if (const auto c = choices_[vehicle])
    room_.give_back(vehicle, *c);
  choices_[vehicle] = local;
}

void attempt::enter(int vehicle, choice c) {
  if (c)
    room_.occupy(vehicle, *c);
  choices_[vehicle] = c;
}

bool attempt::move(int vehicle, choice c) {
  const auto before = choices_[vehicle];
  if (problem_.advantage_of(vehicle, c)
      <= problem_.advantage_of(vehicle, before) + problem_.rounding)
    return false;
  if (!allowed(vehicle, c))
    return false;
  leave(vehicle);
  enter(vehicle, c);
  return true;
}

bool attempt::exchange(int one, int other) {
  const auto of_one = choices_[one];
  const auto of_other = choices_[other];
  const auto before = problem_.advantage_of(one, of_one)
                      + problem_.advantage_of(other, of_other);
  const auto after = problem_.advantage_of(one, of_other)
                     + problem_.advantage_of(other, of_one);
  if (of_one == of_other || after <= before + problem_.rounding)
    return false;
  leave(one);
  leave(other);
  if (allowed(one, of_other) && allowed(other, of_one)) {
    enter(one, of_other);
    enter(other, of_one);
    return true;
  }
  enter(one, of_one);
  enter(other, of_other);
  return false;
}

void attempt::improve() {
  bool better = true;
  while (better) {
    better = false;
    for (int v = 0; v < problem_.vehicles(); ++v) {
      for (int i = 0; i < problem_.providers(); ++i)
        better |= move(v, i);
      for (int other = 0; other < v; ++other)
        better |= exchange(v, other);
    }
  }
}

} // namespace

solution greedy_regret(const problem& p) {
  const auto s = stakes_of(p);
  solution best{std::vector<choice>(p.vehicles(), local), s.all_local};
  for (const auto& desire : {s.advantage, advantage_per_share(s), margins(s)}) {
    attempt a{s};
    a.serve_by(desire);
    a.improve();
    if (const auto v = value(p, a.choices()); v > best.value)
      best = {a.choices(), v};
  }
  return best;
}

} // namespace sofof::policies::assignment
