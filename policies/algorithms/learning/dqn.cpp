// Learns with a neural network what actions are worth.
#include "policies/algorithms/learning/dqn.hpp"

#include "policies/algorithms/learning/state_text.hpp"
#include "policies/algorithms/learning/td_loss.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

namespace {

using Eigen::Index;

constexpr std::string_view dqn_text = "dqn";
constexpr std::uint64_t dqn_version = 1;

std::uint64_t size(Index number) {
  return static_cast<std::uint64_t>(number);
}

void copy(std::span<const double> from, Eigen::MatrixXd& to, Index column) {
  std::ranges::copy(from, to.col(column).data());
}

std::span<const double> column(const Eigen::MatrixXd& values, Index k) {
  return {values.col(k).data(), static_cast<std::size_t>(values.rows())};
}

} // namespace

dqn::dqn(const dqn_options& options, const random_stream& draws)
    : options_{options}, exploring_{draws.part("exploring")},
      drawing_{draws.part("drawing")}, network_{options.shape,
                                                draws.part("weights")},
      target_{network_}, optimiser_{network_.weights().size(), options.rate},
      memory_{size(options.shape.features), options.memory},
      states_{options.shape.features, static_cast<Index>(options.batch)},
      next_states_{states_}, places_(options.batch), actions_(options.batch),
      targets_(options.batch) {
  assert(options.shape.actions <= static_cast<Index>(action_set{}.size()));
  assert(options.discount >= 0 && options.discount <= 1);
  assert(options.batch >= 1 && options.memory >= options.batch);
  assert(options.target_copy_every >= 1);
}

std::optional<std::size_t> dqn::choose(std::span<const double> state,
                                       action_set allowed) {
  const auto share = options_.explore.share(decisions_);
  return explore_or_best(values(state), allowed, share, exploring_,
                         decisions_++);
}

std::optional<std::size_t> dqn::best(std::span<const double> state,
                                     action_set allowed) {
  return best_action(values(state), allowed);
}

std::span<const double> dqn::values(std::span<const double> state) {
  assert(state.size() == size(options_.shape.features));
  const Eigen::Map<const Eigen::MatrixXd> features{state.data(),
                                                   options_.shape.features, 1};
  network_.forward(features, single_);
  return column(single_.values, 0);
}

void dqn::learn(const experience& lived) {
  memory_.add(lived);
  if (memory_.size() < options_.batch)
    return;
  draw_batch();
  set_targets();
  train();
}

void dqn::draw_batch() {
  for (std::size_t k = 0; k < options_.batch; ++k) {
    const auto lane = static_cast<std::uint32_t>(k);
    places_[k] = drawing_.bits(steps_, lane) % memory_.size();
    const auto drawn = memory_[places_[k]];
    const auto column = static_cast<Index>(k);
    copy(drawn.state, states_, column);
    if (drawn.next.empty())
      next_states_.col(column).setZero();
    else
      copy(drawn.next, next_states_, column);
    actions_[k] = drawn.action;
  }
}

void dqn::set_targets() {
  network_.forward(next_states_, there_);
  target_.forward(next_states_, there_by_target_);
  for (std::size_t k = 0; k < options_.batch; ++k) {
    const auto drawn = memory_[places_[k]];
    const auto n = static_cast<Index>(k);
    targets_[k] = drawn.reward;
    if (drawn.next.empty())
      continue;
    if (const auto next =
            best_action(column(there_.values, n), drawn.next_allowed))
      targets_[k] += options_.discount
                     * there_by_target_.values(static_cast<Index>(*next), n);
  }
}

void dqn::train() {
  network_.forward(states_, here_);
  td_loss(here_.values, actions_, targets_, slopes_);
  network_.backward(states_, here_, slopes_, gradient_);
  optimiser_.step(network_.weights(), gradient_);
  if (++steps_ % options_.target_copy_every == 0)
    target_.weights() = network_.weights();
}

std::string dqn::snapshot() const {
  state_writer out{dqn_text, dqn_version};
  out.word("features").count(size(options_.shape.features));
  out.word("actions").count(size(options_.shape.actions));
  out.word("width").count(size(options_.shape.width));
  out.line().word("decisions").count(decisions_);
  out.word("steps").count(steps_);
  for (const auto weight : network_.weights())
    out.line().number(weight);
  return out.text();
}

std::optional<std::string> dqn::restore(std::string_view snapshot) {
  state_reader in{snapshot, dqn_text, dqn_version};
  in.expect("features", size(options_.shape.features));
  in.expect("actions", size(options_.shape.actions));
  in.expect("width", size(options_.shape.width));
  in.expect("decisions");
  const auto decisions = in.count();
  in.expect("steps");
  const auto steps = in.count();
  Eigen::VectorXd weights{network_.weights().size()};
  for (auto& weight : weights)
    weight = in.number();
  in.expect_end();
  if (in.failed())
    return in.fault();
  decisions_ = decisions;
  steps_ = steps;
  network_.weights() = weights;
  target_ = network_;
  optimiser_ = adam{weights.size(), options_.rate};
  memory_ = replay{size(options_.shape.features), options_.memory};
  return std::nullopt;
}

} // namespace sofof::policies
