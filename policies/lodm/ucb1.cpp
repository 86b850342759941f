// LODM "ucb1": tries what is promising or little known.
#include "policies/algorithms/learning/ucb1.hpp"

#include "policies/algorithms/learning/bandit_lodm.hpp"
#include "policies/algorithms/learning/state_text.hpp"
#include "policies/api/weights.hpp"
#include "policies/entry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sofof::policies {

namespace {

constexpr std::size_t most_arms = 32;

/// The vehicle itself is an arm, and every provider that it has met, up to 31.
/// A cycle is worth 1 − K, at least 0.
class places final : public bandit {
public:
  explicit places(const cost_weights& weights) : weights_{weights} {}

  std::optional<chosen_place> choose(const local_context& context) override {
    needs_ = context.needs;
    reference_j_ = context.on_board.energy_j;
    action_set allowed{1}; // on board
    for (const auto& provider : context.providers)
      if (const auto place = arm_of(provider.id); place < most_arms)
        allowed.set(place);
    const auto chosen = bandit_.choose(allowed);
    if (!chosen)
      return std::nullopt;
    return chosen_place{known_[*chosen]};
  }
  std::optional<double> value(const cycle_outcome& outcome,
                              service_place) const override {
    const auto cost =
        weighed({outcome.latency_s, outcome.energy_j}, outcome.missed ? 1 : 0,
                needs_, reference_j_, weights_);
    return cost < 1 ? 1 - cost : 0; // also when it is no number
  }
  void learn(service_place place, std::optional<double> mean) override {
    if (!place && !mean)
      return;
    if (const auto arm = arm_of(place); arm < most_arms)
      bandit_.learn(arm, mean.value_or(0));
  }

  std::string snapshot() const override {
    state_writer out{"places", 1};
    out.word("providers").count(known_.size() - 1);
    for (std::size_t k = 1; k < known_.size(); ++k)
      out.count(known_[k]->value());
    return out.text() + bandit_.snapshot();
  }
  std::optional<std::string> restore(std::string_view text) override;
  std::unique_ptr<bandit> clone() const override {
    return std::make_unique<places>(*this);
  }

private:
  std::size_t arm_of(service_place place) {
    const auto found = std::ranges::find(known_, place);
    const auto arm = static_cast<std::size_t>(found - known_.begin());
    if (arm == known_.size() && arm < most_arms)
      known_.push_back(place);
    return arm;
  }

  cost_weights weights_;
  service_needs needs_;
  double reference_j_ = 0;
  std::vector<service_place> known_{std::nullopt}; // by arm
  ucb1 bandit_{most_arms};
};

std::optional<std::string> places::restore(std::string_view text) {
  state_reader in{text, "places", 1};
  in.expect("providers");
  places read{weights_};
  for (auto left = in.count(most_arms - 1); left > 0 && !in.failed(); --left) {
    const provider_id provider{in.count(~provider_id::rep{0})};
    if (provider == 0)
      in.refuse("expected providers, whose numbers are at least 1.");
    else if (read.arm_of(provider) + 1 != read.known_.size())
      in.refuse("expected each provider once.");
  }
  const auto rest = in.after_end();
  if (in.failed())
    return in.fault();
  if (auto fault = read.bandit_.restore(placed_in(text, rest)))
    return fault;
  *this = std::move(read);
  return std::nullopt;
}

class ucb1_lodm final : public bandit_lodm {
public:
  ucb1_lodm()
      : bandit_lodm{fmt::format("up to {} places, version 1", most_arms)} {}

  void visit_options(option_visitor& s) override {
    bandit_lodm::visit_options(s);
    list_weights(s, weights_);
  }
  std::string_view name() const override { return "ucb1"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<ucb1_lodm>(*this);
  }

private:
  std::unique_ptr<bandit> make_bandit() const override {
    return std::make_unique<places>(weights_);
  }

  cost_weights weights_;
};

} // namespace

lodm_entry lodm_ucb1() {
  return {{"ucb1",
           "Tries the vehicle and all providers, the promising ones most.",
           "max m + sqrt(2 ln t / k); m mean of 1 - K (at least 0) in k of t "
           "trials, K as of greedy_gain; 0 for a place that refuses",
           "latency, energy and punctuality of what it has tried",
           "Auer, Cesa-Bianchi & Fischer, Machine Learning 47, 2002",
           trials_and(weights_and({}))},
          filtered_by_provider<ucb1_lodm>};
}

} // namespace sofof::policies
