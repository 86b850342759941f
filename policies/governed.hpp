// An LODM and its governors.
#pragma once

#include "policies/api/governor.hpp"
#include "policies/api/policy.hpp"

#include <memory>
#include <vector>

namespace sofof::policies {

/// Asks the policy, then one governor after the other. Goes by the name of the
/// policy; without governors it is the policy. Is asked as often as that of its
/// parts that wants to be asked most often.
class governed_lodm final : public local_policy {
public:
  explicit governed_lodm(std::unique_ptr<local_policy> whole);

  local_decision decide(const local_context& context) override;
  /// That of the policy; governors may choose all the same.
  reason objection(const local_context& context,
                   const provider_view& provider) const override {
    return whole_->objection(context, provider);
  }
  void observe(const cycle_outcome& outcome) override;
  void observe(const refusal_outcome& outcome) override;
  void observe(const episode_outcome& outcome) override;
  double epoch_s() const override;
  bool needs_scene() const override;
  bool needs_forecast() const override;
  bool needs_chain() const override { return whole_->needs_chain(); }
  bool foresees_home(const local_context& context) const override;
  std::string snapshot() const override { return whole_->snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return whole_->restore(text);
  }
  program_use<local_policy>* program() override { return whole_->program(); }
  snapshot_use* learned_from() override { return whole_->learned_from(); }
  /// Those of the policy, and the list `govern`.
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return whole_->name(); }
  std::string title() const override;
  std::unique_ptr<local_policy> clone() const override;

private:
  std::unique_ptr<local_policy> whole_;
  std::vector<std::unique_ptr<governor>> governors_;
};

} // namespace sofof::policies
