// What learns whether a change pays: a table or a network.
#include "policies/algorithms/learning/q_function.hpp"

#include "policies/algorithms/learning/dqn.hpp"
#include "policies/algorithms/learning/q_learning.hpp"

#include <fmt/format.h>

#include <span>

namespace sofof::policies {

namespace {

constexpr std::size_t actions = 2;
const auto both = first_actions(actions);
const random_stream draws{1, "learners"};

class q_table final : public q_function {
public:
  explicit q_table(const learner_options& how)
      : learner_{
          {offloading_cells, actions, how.discount, std::nullopt, how.explore},
          draws} {}

  double change_pays(const mind_state& state) override {
    const auto values = learner_.values(state.cell);
    return values[to_change] - values[to_keep];
  }
  std::size_t explore(const mind_state& state) override {
    return learner_.choose(state.cell, both).value_or(to_keep);
  }
  void learn(const mind_step& step) override {
    q_sample sample{step.state.cell, step.action, step.reward, {}, both};
    if (step.next)
      sample.next = step.next->cell;
    learner_.learn(sample);
  }
  std::string shape() const override {
    return fmt::format("{} states, {} actions, version {} of what is seen",
                       offloading_cells, actions, offloading_version);
  }
  std::string snapshot() const override { return learner_.snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return learner_.restore(text);
  }
  std::unique_ptr<q_function> clone() const override {
    return std::make_unique<q_table>(*this);
  }

private:
  q_learning learner_;
};

class q_network final : public q_function {
public:
  explicit q_network(const learner_options& how)
      : learner_{{.shape = {offloading_features, actions},
                  .discount = how.discount,
                  .explore = how.explore},
                 draws} {}

  double change_pays(const mind_state& state) override {
    const auto values = learner_.values(state.features);
    return values[to_change] - values[to_keep];
  }
  std::size_t explore(const mind_state& state) override {
    return learner_.choose(state.features, both).value_or(to_keep);
  }
  void learn(const mind_step& step) override {
    std::span<const double> next;
    if (step.next)
      next = step.next->features;
    learner_.learn({step.state.features, step.action, step.reward, next, both});
  }
  std::string shape() const override {
    return fmt::format("{} features, {} actions, width {}, version {} of what "
                       "is seen",
                       offloading_features, actions, network_shape{}.width,
                       offloading_version);
  }
  std::string snapshot() const override { return learner_.snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return learner_.restore(text);
  }
  std::unique_ptr<q_function> clone() const override {
    return std::make_unique<q_network>(*this);
  }

private:
  dqn learner_;
};

} // namespace

std::unique_ptr<q_function> make_q_table(const learner_options& how) {
  return std::make_unique<q_table>(how);
}

std::unique_ptr<q_function> make_q_network(const learner_options& how) {
  return std::make_unique<q_network>(how);
}

} // namespace sofof::policies
