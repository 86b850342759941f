// A policy made of parts: a filter, then a choice among what is left.
#pragma once

#include "policies/api/filter.hpp"
#include "policies/api/policy.hpp"

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::policies {

/// What both sides have in common. Goes by the name of its choice.
template <class Policy, class Filter, class Context, class Candidate>
class filtered_policy : public Policy {
public:
  filtered_policy(std::unique_ptr<Filter> filter,
                  std::unique_ptr<Policy> choice)
      : filter_{std::move(filter)}, choice_{std::move(choice)} {
    assert(filter_ && choice_);
  }

  reason objection(const Context& context,
                   const Candidate& candidate) const override {
    return filter_->objection(context, candidate);
  }
  void observe(const cycle_outcome& outcome) override {
    choice_->observe(outcome);
  }
  void observe(const refusal_outcome& outcome) override {
    choice_->observe(outcome);
  }
  void observe(const episode_outcome& outcome) override {
    choice_->observe(outcome);
  }
  double epoch_s() const override { return choice_->epoch_s(); }
  bool needs_scene() const override { return choice_->needs_scene(); }
  bool needs_forecast() const override { return choice_->needs_forecast(); }
  bool needs_chain() const override { return choice_->needs_chain(); }
  std::string snapshot() const override { return choice_->snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return choice_->restore(text);
  }
  program_use<Policy>* program() override { return choice_->program(); }
  snapshot_use* learned_from() override { return choice_->learned_from(); }
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return choice_->name(); }
  std::string title() const override { return choice_->title(); }

protected:
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Policy> choice_;
};

/// LODM: `choice` chooses among the providers that the filter has no objection
/// to, the one where the service runs not excepted; "location" unless options
/// say otherwise. When none is left nobody is asked; where the service runs
/// already, the choice is to stay or to come home.
class filtered_lodm final
    : public filtered_policy<local_policy, local_filter, local_context,
                             provider_view> {
public:
  explicit filtered_lodm(std::unique_ptr<local_policy> choice);

  local_decision decide(const local_context& context) override;
  /// Also if the filter would not let through where it runs.
  bool foresees_home(const local_context& context) const override;
  std::unique_ptr<local_policy> clone() const override;
};

/// CODM: the same for requests. What its choice says of sessions holds.
class filtered_codm final
    : public filtered_policy<central_policy, central_filter, central_context,
                             request_view> {
public:
  explicit filtered_codm(std::unique_ptr<central_policy> choice);

  std::vector<central_decision> decide(const central_context& context) override;
  std::unique_ptr<central_policy> clone() const override;
};

} // namespace sofof::policies
