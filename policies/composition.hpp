// A policy made of parts: a filter, then a choice among what is left.
#pragma once

#include "policies/filter.hpp"

#include <memory>
#include <utility>

namespace sofof {

/// What both sides have in common. Goes by the name of its choice.
template <class Policy, class Filter>
class filtered_policy : public Policy {
public:
  filtered_policy(std::unique_ptr<Filter> filter,
                  std::unique_ptr<Policy> choice)
      : filter_{std::move(filter)}, choice_{std::move(choice)} {}

  void observe(const cycle_outcome& outcome) override {
    choice_->observe(outcome);
  }
  void observe(const episode_outcome& outcome) override {
    choice_->observe(outcome);
  }
  void fields(settings& s) override;
  std::string_view name() const override { return choice_->name(); }

protected:
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Policy> choice_;
};

/// LODM: `choice` chooses among the providers that the filter has no objection
/// to; "location" unless options say otherwise.
class filtered_lodm final : public filtered_policy<local_policy, local_filter> {
public:
  explicit filtered_lodm(std::unique_ptr<local_policy> choice);

  local_decision decide(const local_context& context) override;
  std::unique_ptr<local_policy> clone() const override;
};

/// CODM: the same for requests.
class filtered_codm final
    : public filtered_policy<central_policy, central_filter> {
public:
  explicit filtered_codm(std::unique_ptr<central_policy> choice);

  std::vector<central_decision> decide(const central_context& context) override;
  std::unique_ptr<central_policy> clone() const override;
};

} // namespace sofof
