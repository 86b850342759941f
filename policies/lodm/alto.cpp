// LODM "alto": learns which provider is quickest.
#include "policies/algorithms/learning/alto.hpp"

#include "policies/algorithms/learning/bandit_lodm.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

namespace {

/// The providers that come into question. There is no arm for the vehicle: it
/// is quicker than any of them, and what ALTO learns is delay.
class quickest final : public bandit {
public:
  quickest(const alto_options& options, double task_bits)
      : bandit_{options}, task_bits_{task_bits},
        worst_s_{options.worst_delay_s_per_bit * task_bits} {}

  std::optional<chosen_place> choose(const local_context& context) override {
    std::vector<provider_id> present;
    for (const auto& provider : context.providers)
      present.push_back(provider.id);
    const auto chosen = bandit_.choose(task_bits_, present);
    if (!chosen)
      return std::nullopt;
    return chosen_place{*chosen};
  }
  std::optional<double> value(const cycle_outcome& outcome,
                              service_place place) const override {
    if (outcome.computed_at != place)
      return std::nullopt;
    return std::min(outcome.latency_s, worst_s_); // what is lost as well
  }
  void learn(service_place place, std::optional<double> mean) override {
    assert(place); // there is no arm for the vehicle
    bandit_.learn(*place, task_bits_, mean.value_or(worst_s_));
  }
  std::string snapshot() const override { return bandit_.snapshot(); }
  std::optional<std::string> restore(std::string_view text) override {
    return bandit_.restore(text);
  }
  std::unique_ptr<bandit> clone() const override {
    return std::make_unique<quickest>(*this);
  }

private:
  alto bandit_;
  double task_bits_;
  double worst_s_;
};

class alto_lodm final : public bandit_lodm {
public:
  alto_lodm() : bandit_lodm{"delays of places, version 1"} {}

  void visit_options(option_visitor& s) override {
    bandit_lodm::visit_options(s);
    s.field("beta", beta_, {0, 1e3});
    s.field("task_bits", task_bits_, {1, 1e12});
    s.field("worst_delay", worst_delay_, std::chrono::microseconds{1});
  }
  std::string_view name() const override { return "alto"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<alto_lodm>(*this);
  }

private:
  std::unique_ptr<bandit> make_bandit() const override {
    alto_options options;
    options.beta = beta_;
    options.worst_delay_s_per_bit = to_seconds(worst_delay_) / task_bits_;
    return std::make_unique<quickest>(options, task_bits_);
  }

  double beta_ = alto_options{}.beta;
  double task_bits_ = 160e3;
  duration worst_delay_ = std::chrono::milliseconds{50};
};

} // namespace

lodm_entry lodm_alto() {
  return {
      {"alto", "Learns which provider is quickest, where they come and go.",
       "min u - sqrt(beta (1 - x) ln(t - a) / k); u mean delay in k trials, "
       "in parts of the worst, a the trial when the provider appeared, x "
       "size of the task",
       "the latency of what came from each provider; who refuses counts as "
       "the worst",
       "Sun et al., IEEE TVT 68(4), 2019",
       trials_and({{"beta", "1", "weight of trying out"},
                   {"task_bits", "bit",
                    "input of a cycle; 80e3 try out most, from 320e3 on "
                    "nothing is tried out"},
                   {"worst_delay", "time",
                    "of such a task; what is lost counts as this"}})},
      filtered_by_provider<alto_lodm>};
}

} // namespace sofof::policies
