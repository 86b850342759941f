// A bandit as the decision of a vehicle.
#pragma once

#include "policies/algorithms/learning/bandit_trial.hpp"
#include "policies/api/context.hpp"
#include "policies/api/notes.hpp"

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::policies {

/// Where a service is tried next. A struct, as an optional of a place, itself
/// an optional, would be taken for the place: "no choice" for the vehicle.
struct chosen_place {
  service_place place;
};

/// Where one service is tried.
class bandit {
public:
  virtual ~bandit() = default;

  /// @returns nullopt where there is no choice.
  virtual std::optional<chosen_place> choose(const local_context& context) = 0;
  /// @returns what a cycle counts in a trial; nullopt: nothing.
  virtual std::optional<double> value(const cycle_outcome& outcome,
                                      service_place place) const = 0;
  /// @param mean  Of a cycle; nullopt: nothing came, or the place refused.
  virtual void learn(service_place place, std::optional<double> mean) = 0;

  virtual std::string snapshot() const = 0;
  virtual std::optional<std::string> restore(std::string_view text) = 0;
  virtual std::unique_ptr<bandit> clone() const = 0;
};

/// Tries each service of a vehicle for a while where a bandit of its own says.
/// A trial ends early when the place refuses, when the service does not run
/// there any more, or when the place does not come into question any more.
///
/// A clone has bandits of its own, which begin with what those of the other one
/// had learned; with `learning` all clones share them, and every vehicle of a
/// run teaches them.
class bandit_lodm : public local_policy {
public:
  bandit_lodm(const bandit_lodm& other) : local_policy{} { *this = other; }
  bandit_lodm& operator=(const bandit_lodm& other);

  local_decision decide(const local_context& context) override;
  void observe(const cycle_outcome& outcome) override;
  void observe(const refusal_outcome& outcome) override;
  void observe(const episode_outcome& outcome) override;
  double epoch_s() const override { return epoch_s_; }
  snapshot_use* learned_from() override { return &learned_from_; }
  std::string snapshot() const override;
  std::optional<std::string> restore(std::string_view text) override;
  void visit_options(option_visitor& s) override;

protected:
  /// @param shape  `snapshot_use::shape`.
  explicit bandit_lodm(std::string shape)
      : learned_from_{{}, std::move(shape)} {}

  /// @returns a bandit that knows nothing.
  virtual std::unique_ptr<bandit> make_bandit() const = 0;

private:
  /// By the names of services.
  using bandits = std::map<std::string, std::unique_ptr<bandit>, std::less<>>;
  struct shared_bandits {
    bandits all;
    std::mutex busy;
  };

  bandit& learner_of(std::string_view name) const;
  bandit_trial& trial_of(std::string_view name);
  bandit_trial* running(std::string_view name, service_place place);
  void conclude(std::string_view name, time_point now);

  bool learning_ = false;
  snapshot_use learned_from_;
  duration trial_ = std::chrono::seconds{2};
  double epoch_s_ = 0.1;
  std::shared_ptr<shared_bandits> shared_ = std::make_shared<shared_bandits>();
  std::map<std::string, bandit_trial, std::less<>> trials_;
};

/// @returns what is said of the options of `bandit_lodm`, then `others`.
std::vector<option_info> trials_and(const std::vector<option_info>& others);

} // namespace sofof::policies
