// Learns from a table of states and actions what each is worth.
#include "policies/algorithms/learning/q_learning.hpp"

#include "policies/algorithms/learning/state_text.hpp"

#include <cassert>
#include <cmath>
#include <utility>

namespace sofof::policies {

namespace {

constexpr std::string_view q_learning_text = "q_learning";
constexpr std::uint64_t q_learning_version = 1;

constexpr double rate_exponent = 0.7;

} // namespace

q_learning::q_learning(const q_learning_options& options,
                       const random_stream& draws)
    : options_{options}, draws_{draws},
      values_(options.states * options.actions),
      samples_(options.states * options.actions) {
  assert(options.actions <= action_set{}.size());
  assert(options.discount >= 0 && options.discount <= 1);
  assert(!options.learning_rate
         || (*options.learning_rate >= 0 && *options.learning_rate <= 1));
}

std::optional<std::size_t> q_learning::choose(std::size_t state,
                                              action_set allowed) {
  const auto share = options_.explore.share(decisions_);
  return explore_or_best(values(state), allowed, share, draws_, decisions_++);
}

std::optional<std::size_t> q_learning::best(std::size_t state,
                                            action_set allowed) const {
  return best_action(values(state), allowed);
}

void q_learning::learn(const q_sample& sample) {
  assert(sample.state < options_.states && sample.action < options_.actions);
  auto target = sample.reward;
  if (sample.next)
    if (const auto action = best(*sample.next, sample.next_allowed))
      target += options_.discount * values(*sample.next)[*action];
  const auto here = cell(sample.state, sample.action);
  const auto earlier = static_cast<double>(samples_[here]++);
  const auto rate =
      options_.learning_rate.value_or(std::pow(1 + earlier, -rate_exponent));
  values_[here] += rate * (target - values_[here]);
}

std::span<const double> q_learning::values(std::size_t state) const {
  assert(state < options_.states);
  return std::span{values_}.subspan(cell(state, 0), options_.actions);
}

std::string q_learning::snapshot() const {
  state_writer out{q_learning_text, q_learning_version};
  out.word("states").count(options_.states);
  out.word("actions").count(options_.actions);
  out.word("decisions").count(decisions_);
  for (std::size_t i = 0; i < values_.size(); ++i)
    out.line().number(values_[i]).count(samples_[i]);
  return out.text();
}

std::optional<std::string> q_learning::restore(std::string_view snapshot) {
  state_reader in{snapshot, q_learning_text, q_learning_version};
  in.expect("states", options_.states);
  in.expect("actions", options_.actions);
  q_learning read{options_, draws_};
  in.expect("decisions");
  read.decisions_ = in.count();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    read.values_[i] = in.number();
    read.samples_[i] = in.count();
  }
  in.expect_end();
  if (!in.failed())
    *this = std::move(read);
  return in.fault();
}

} // namespace sofof::policies
