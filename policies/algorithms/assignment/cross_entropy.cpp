// Optimisation by sampling: what the best samples have in common is drawn more
// often next time.
#include "policies/algorithms/assignment/cross_entropy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace sofof::policies {

namespace {

/// For each variable the probabilities of its categories.
using distribution = std::vector<std::vector<double>>;

int draw(const std::vector<double>& probabilities, double uniform) {
  const auto last = static_cast<int>(probabilities.size()) - 1;
  for (int c = 0; c < last; ++c) {
    uniform -= probabilities[c];
    if (uniform < 0)
      return c;
  }
  return last;
}

std::vector<sampled_optimum> draw_samples(const distribution& probabilities,
                                          const sample_score& score, int count,
                                          const random_stream& random) {
  std::vector<sampled_optimum> samples(count);
  for (int s = 0; s < count; ++s) {
    auto& categories = samples[s].categories;
    for (std::uint32_t v = 0; v < probabilities.size(); ++v)
      categories.push_back(draw(probabilities[v], random.uniform(s, v)));
    samples[s].score = score(categories);
  }
  return samples;
}

void move_towards(distribution& probabilities,
                  std::span<const sampled_optimum> elite, double smoothing) {
  const auto step = smoothing / static_cast<double>(elite.size());
  for (std::size_t v = 0; v < probabilities.size(); ++v) {
    for (auto& p : probabilities[v])
      p *= 1 - smoothing;
    for (const auto& sample : elite)
      probabilities[v][sample.categories[v]] += step;
  }
}

} // namespace

sampled_optimum cross_entropy(std::span<const int> category_counts,
                              const sample_score& score,
                              const cross_entropy_options& options,
                              const random_stream& random) {
  assert(options.samples >= 1 && options.iterations >= 0);
  assert(options.elite > 0 && options.elite <= 1);
  assert(options.smoothing > 0 && options.smoothing <= 1);
  assert(std::ranges::all_of(category_counts, [](int n) { return n >= 1; }));
  distribution probabilities;
  for (const auto count : category_counts)
    probabilities.emplace_back(count, 1.0 / count);
  sampled_optimum best{std::vector<int>(category_counts.size()), 0};
  best.score = score(best.categories);
  const auto elite =
      std::clamp(static_cast<int>(std::lround(options.elite * options.samples)),
                 1, options.samples);
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    auto samples = draw_samples(probabilities, score, options.samples,
                                random.part(iteration));
    std::stable_sort(samples.begin(), samples.end(),
                     [](const sampled_optimum& a, const sampled_optimum& b) {
                       return a.score > b.score;
                     });
    if (samples.front().score > best.score)
      best = samples.front();
    move_towards(probabilities, std::span{samples}.first(elite),
                 options.smoothing);
  }
  return best;
}

} // namespace sofof::policies
