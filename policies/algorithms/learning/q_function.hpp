// What learns whether a change pays: a table or a network, behind one face.
#pragma once

#include "policies/algorithms/learning/exploration.hpp"
#include "policies/algorithms/learning/offloading_state.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::policies {

/// What it sees, in both forms.
struct mind_state {
  explicit mind_state(const offloading_view& view)
      : cell{cell_of(view)}, features{features_of(view)} {}

  std::size_t cell;
  std::array<double, offloading_features> features;
};

/// Of each state there are two actions.
inline constexpr std::size_t to_keep = 0, to_change = 1;

/// One step of what a service went through.
struct mind_step {
  mind_state state;
  std::size_t action = to_keep;
  double reward = 0;
  std::optional<mind_state> next; ///< None where the area ends.
};

class q_function {
public:
  virtual ~q_function() = default;

  /// @returns what a change is worth more than none.
  virtual double change_pays(const mind_state& state) = 0;
  /// Decides, exploring.
  virtual std::size_t explore(const mind_state& state) = 0;
  virtual void learn(const mind_step& step) = 0;

  /// @returns what its snapshots fit to, in words.
  virtual std::string shape() const = 0;
  virtual std::string snapshot() const = 0;
  virtual std::optional<std::string> restore(std::string_view text) = 0;
  virtual std::unique_ptr<q_function> clone() const = 0;
};

/// How a mind learns.
struct learner_options {
  double discount = 0.95; ///< Of the next step's reward, 0..1.
  exploration explore;

  friend bool operator==(const learner_options&,
                         const learner_options&) = default;
};

/// @returns one that knows nothing: a table, or a network with drawn weights.
std::unique_ptr<q_function> make_q_table(const learner_options& how);
std::unique_ptr<q_function> make_q_network(const learner_options& how);

} // namespace sofof::policies
