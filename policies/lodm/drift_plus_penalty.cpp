// LODM "drift_plus_penalty": least energy with a budget of late results.
#include "policies/algorithms/lyapunov/drift_plus_penalty.hpp"

#include "policies/entry.hpp"

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace sofof::policies {

namespace {

/// Each epoch has every service where its price is least. Of equal prices the
/// first is taken: to stay, then to come home.
class drift_plus_penalty_lodm final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    places_.clear();
    choices_.clear();
    if (const auto* here = where_it_runs(context))
      add(*here);
    places_.push_back(std::nullopt);
    choices_.push_back({context.on_board.energy_j, 0});
    for (const auto& provider : context.providers)
      if (provider.id != context.current)
        add(provider);
    const auto place = places_[of(context.service).core.choose(choices_)];
    return at_place(context.current, place, "the least price");
  }

  void observe(const cycle_outcome& outcome) override {
    auto& service = of(outcome.service);
    service.untold += outcome.cycles;
    for (; service.untold >= 1; --service.untold)
      service.core.observe({outcome.missed, outcome.energy_j});
  }

  void visit_options(option_visitor& s) override {
    s.field("V", options_.energy_weight, {0, 1e9});
    s.field("violation_budget", options_.violation_budget, {0, 1});
    s.field("energy_budget_j", energy_budget_j_, {0, 1e9});
    s.field("epoch_s", epoch_s_, {1e-3, 3600});
  }
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "drift_plus_penalty"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<drift_plus_penalty_lodm>(*this);
  }

private:
  struct service {
    drift_plus_penalty core;
    double untold = 0; // part of a cycle
  };

  service& of(std::string_view name) {
    auto i = services_.find(name);
    if (i == services_.end()) {
      auto options = options_;
      if (energy_budget_j_ > 0)
        options.energy_budget_j = energy_budget_j_;
      i = services_.emplace(name, service{drift_plus_penalty{options}}).first;
    }
    return i->second;
  }

  void add(const provider_view& provider) {
    places_.push_back(provider.id);
    choices_.push_back({provider.cost.energy_j, provider.link.late});
  }

  drift_plus_penalty_options options_;
  double energy_budget_j_ = 0; // 0: there is none
  double epoch_s_ = 0.1;
  std::map<std::string, service, std::less<>> services_;
  std::vector<service_place> places_; // of the choices
  std::vector<planning_option> choices_;
};

} // namespace

lodm_entry lodm_drift_plus_penalty() {
  return {{"drift_plus_penalty",
           "Least energy with a budget of late results.",
           "min V E + Z P(T > limit) + Y E; Z <- [Z + missed - "
           "violation_budget]+, Y <- [Y + E - energy_budget_j]+",
           "energy of a cycle here and there, the forecast of late results, "
           "what became of each cycle",
           "Neely, Stochastic Network Optimization, 2010, chapter 4",
           {{"V", "1/J", "what energy counts beside debts"},
            {"violation_budget", "1", "missed cycles per cycle"},
            {"energy_budget_j", "J", "mean of a cycle at most; 0: any"},
            {"epoch_s", "s", "between two decisions"}}},
          filtered_by_provider<drift_plus_penalty_lodm>};
}

} // namespace sofof::policies
