// A policy in whose place a program decides, on both sides alike.
#pragma once

#include "base/protocol.hpp"
#include "policies/api/decision.hpp"
#include "policies/api/notes.hpp"
#include "policies/api/policy.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sofof::policies {

/// Passes on what it is asked and told to the decider of its `program()`, which
/// all its clones share. Before a run connects one, it leaves all as it is, and
/// refuses everybody.
template <class Context, class Decision, class Candidate>
class process_policy final : public policy<Context, Decision, Candidate> {
public:
  using whole_policy = policy<Context, Decision, Candidate>;

  Decision decide(const Context& context) override {
    if (use_.decider)
      return use_.decider->decide(context);
    if constexpr (is_local)
      return as_it_is("no program is connected");
    else
      return {};
  }
  void observe(const cycle_outcome& x) override { pass_on(x); }
  void observe(const refusal_outcome& x) override { pass_on(x); }
  void observe(const episode_outcome& x) override { pass_on(x); }
  double epoch_s() const override { return epoch_s_; }
  bool needs_scene() const override {
    return use_.decider && use_.decider->needs_scene();
  }
  bool needs_chain() const override {
    return use_.decider && use_.decider->needs_chain();
  }
  bool needs_forecast() const override {
    return use_.decider && use_.decider->needs_forecast();
  }
  program_use<whole_policy>* program() override { return &use_; }
  void visit_options(option_visitor& s) override {
    s.field("command", use_.command); // whoever loads it needs one
    s.field("folder", use_.folder);
    s.field("time_limit", use_.time_limit, std::chrono::milliseconds{1});
    if (use_.time_limit > std::chrono::hours{1})
      s.refuse("time_limit", "must not be more than \"1h\".");
    s.field("epoch_s", epoch_s_, {0, longest_epoch_s});
  }
  std::string_view name() const override { return "process"; }
  std::string title() const override {
    return use_.decider ? use_.decider->title() : std::string{name()};
  }
  std::unique_ptr<whole_policy> clone() const override {
    return std::make_unique<process_policy>(*this);
  }

private:
  static constexpr auto is_local = std::is_same_v<Decision, local_decision>;
  /// Answers have to be back before vehicles give up.
  static constexpr double longest_epoch_s =
      is_local ? 3600 : 0.8 * to_seconds(protocol::request_timeout);

  void pass_on(const auto& outcome) {
    if (use_.decider)
      use_.decider->observe(outcome);
  }

  program_use<whole_policy> use_;
  double epoch_s_ = 0;
};

/// @returns what is said of the options of both.
inline std::vector<option_info> process_notes() {
  return {{"command", "words", "program and arguments, without a shell"},
          {"folder", "name",
           "where it runs, relative to the scenario file; empty: there"},
          {"time_limit", "time", "for each answer, on the wall's clock"},
          {"epoch_s", "s", "between two decisions; 0: whenever one is due"}};
}

} // namespace sofof::policies
