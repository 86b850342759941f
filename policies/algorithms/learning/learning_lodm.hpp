// A learner as the decision of a vehicle.
#pragma once

#include "policies/algorithms/learning/q_function.hpp"
#include "policies/api/context.hpp"
#include "policies/api/notes.hpp"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// Keeps a service where it is or changes that, by what its mind has learned a
/// change to be worth: from the vehicle to the provider where it pays most;
/// from a provider to another one that the vehicle would go to, or home. Only
/// who is in the context is ever chosen, whatever the mind says.
///
/// A frozen policy goes by a snapshot and does not change; its clones have
/// minds of their own. One that learns begins with an empty mind, or with what
/// `restore` gives it, and shares that with all its clones: every vehicle of a
/// run teaches it, and the snapshot of any of them has it all.
///
/// A step lasts an epoch, or until the provider says that the area ends; the
/// area also ends where the filter objects. Its reward is
///
///   −(mean over its cycles of λ_E E/E_0 + λ_V 1{missed}) − λ_S changes,
///
/// changes being its own and those by violations.
class learning_lodm : public local_policy {
public:
  using make_q_function =
      std::unique_ptr<q_function> (*)(const learner_options&);

  /// @param frozen  Snapshot of such a mind, which stays where it is; empty for
  ///                one that knows nothing and keeps all as it is.
  learning_lodm(make_q_function make, const learner_options& how,
                std::string_view frozen);
  learning_lodm(const learning_lodm& other);
  learning_lodm& operator=(const learning_lodm&) = delete;

  local_decision decide(const local_context& context) override;
  void observe(const cycle_outcome& outcome) override;
  void observe(const episode_outcome& outcome) override;
  double epoch_s() const override { return options_.epoch_s; }
  std::string snapshot() const override;
  std::optional<std::string> restore(std::string_view text) override;
  snapshot_use* learned_from() override { return &learned_from_; }
  void visit_options(option_visitor& s) override;

private:
  struct options {
    bool learning = false;
    learner_options how;
    double energy_weight = 0.3;
    double violation_weight = 1;
    double switch_weight = 0.2;
    double radius_m = 300;
    double epoch_s = 0.5;
  };
  /// What a policy and its clones may have in common.
  struct shared_learner {
    std::unique_ptr<q_function> taught;
    std::mutex busy;
  };
  /// What came since a decision.
  struct step {
    mind_state state;
    std::size_t action;
    time_point begin;
    double cost = 0;
    double cycles = 0;
    double changes = 0;
  };
  struct service {
    std::optional<step> open;
    double reference_j = 0;
  };
  /// Where a service may go, and what the mind sees there.
  struct way_out {
    provider_id place;
    mind_state state;
    double pays = 0;
  };

  void renew_mind();
  service& of(std::string_view name);
  mind_state look(const local_context& context, const provider_view& provider,
                  bool is_remote) const;
  std::optional<way_out> best_way_out(const local_context& context);
  std::size_t act(service& seen, const local_context& context,
                  const mind_state& state);
  void conclude(service& seen, const std::optional<mind_state>& next);

  make_q_function make_;
  std::string_view frozen_;
  options options_;
  snapshot_use learned_from_;
  std::shared_ptr<shared_learner> shared_;
  std::map<std::string, service, std::less<>> services_;
};

/// @returns what is said of the options of every `learning_lodm`.
std::vector<option_info> learning_notes();

} // namespace sofof::policies
