// How long policies take to decide, on the wall's clock; none of them knows.
#pragma once

#include "base/reason.hpp"
#include "base/statistics.hpp"
#include "base/stopwatch.hpp"
#include "scenario/scenario.hpp"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::scenario {

/// Times of the decisions of all clones of a policy. Any thread may call these.
class decision_times {
public:
  void add(duration d);

  distribution so_far() const;

private:
  mutable std::mutex mutex_;
  distribution times_{std::chrono::nanoseconds{100},
                      std::chrono::milliseconds{100}};
};

/// A policy, and a watch beside it: does, and is called, whatever the policy
/// does and is. Its clones note their times in the same place.
template <class Context, class Decision, class Candidate>
class timed_policy final
    : public policies::policy<Context, Decision, Candidate> {
public:
  using whole_policy = policies::policy<Context, Decision, Candidate>;

  timed_policy(std::unique_ptr<whole_policy> what,
               std::shared_ptr<decision_times> times)
      : what_{std::move(what)}, times_{std::move(times)} {}

  Decision decide(const Context& context) override {
    const stopwatch watch;
    auto decision = what_->decide(context);
    times_->add(from_seconds(watch.elapsed_s()));
    return decision;
  }

  reason objection(const Context& context,
                   const Candidate& candidate) const override {
    return what_->objection(context, candidate);
  }
  void observe(const policies::cycle_outcome& x) override { what_->observe(x); }
  void observe(const policies::refusal_outcome& x) override {
    what_->observe(x);
  }
  void observe(const policies::episode_outcome& x) override {
    what_->observe(x);
  }
  double epoch_s() const override { return what_->epoch_s(); }
  bool needs_scene() const override { return what_->needs_scene(); }
  bool needs_forecast() const override { return what_->needs_forecast(); }
  bool needs_chain() const override { return what_->needs_chain(); }
  std::string snapshot() const override { return what_->snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return what_->restore(text);
  }
  policies::program_use<whole_policy>* program() override {
    return what_->program();
  }
  policies::snapshot_use* learned_from() override {
    return what_->learned_from();
  }
  void visit_options(option_visitor& s) override { what_->visit_options(s); }
  std::string_view name() const override { return what_->name(); }
  std::string title() const override { return what_->title(); }

  std::unique_ptr<whole_policy> clone() const override {
    return std::make_unique<timed_policy>(what_->clone(), times_);
  }

private:
  std::unique_ptr<whole_policy> what_;
  std::shared_ptr<decision_times> times_;
};

/// What the policies of both sides took.
struct deciding_times {
  std::shared_ptr<decision_times> lodm, codm;

  /// @returns figures for timing.csv, with their names; none for a side that
  /// has not decided anything.
  std::vector<std::pair<std::string, double>> figures() const;
};

/// Puts a watch beside both policies.
/// @param policies  Become copies; what others have of them stays as it is.
deciding_times add_timers(policy_options& policies);

} // namespace sofof::scenario
