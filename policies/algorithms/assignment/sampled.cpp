// An assignment found by sampling: a benchmark that knows everything.
#include "policies/algorithms/assignment/sampled.hpp"

#include "policies/algorithms/assignment/reduced_problem.hpp"

#include <numeric>

namespace sofof::policies::assignment {

namespace {

/// For each vehicle what its categories mean; local is the first.
std::vector<std::vector<choice>> meanings(const reduced_problem& s) {
  std::vector<std::vector<choice>> result(s.vehicles(), {local});
  for (int v = 0; v < s.vehicles(); ++v)
    for (int i = 0; i < s.providers(); ++i)
      if (s.advantage(v, i) > 0)
        result[v].emplace_back(i);
  return result;
}

} // namespace

solution sampled(const problem& p, const cross_entropy_options& options,
                 const random_stream& random) {
  const auto s = stakes_of(p);
  const auto meaning = meanings(s);
  std::vector<int> counts;
  for (const auto& m : meaning)
    counts.push_back(static_cast<int>(m.size()));
  std::vector<int> order(s.vehicles());
  std::iota(order.begin(), order.end(), 0);
  order = leaning_last(p, order);
  std::vector<choice> choices(s.vehicles());
  const auto admit = [&](std::span<int> sample) {
    free_capacity left{s.shares, s.providers()};
    double reached = 0;
    for (const auto v : order) {
      auto c = meaning[v][sample[v]];
      if (c && !left.fits(v, *c)) {
        sample[v] = 0;
        c = local;
      }
      if (c)
        left.occupy(v, *c);
      choices[v] = c;
      reached += s.advantage_of(v, c) - loss_alone(p, choices, v, c);
    }
    return reached;
  };
  const auto best = cross_entropy(counts, admit, options, random);
  solution result;
  for (int v = 0; v < s.vehicles(); ++v)
    result.choices.push_back(meaning[v][best.categories[v]]);
  result.value = value(p, result.choices);
  return result;
}

} // namespace sofof::policies::assignment
