// CODM "drift_plus_penalty": the best for all, with a budget of late results
// for each.
#include "policies/algorithms/assignment/branch_and_bound.hpp"
#include "policies/algorithms/assignment/min_cost_flow.hpp"
#include "policies/algorithms/assignment/provider_assignment.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace sofof::policies {

namespace {

/// The assignment's objective and limits, with V g − Z p̂ for the gain of being
/// here: who was late here more often than its budget allows is not let in, or
/// sent home, until its debt is small enough.
class least_debts final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    auto asked = assignment::problem_of(context, options_);
    auto& p = asked.what;
    const auto worth = energy_weight_ * unit_j_;
    p.gains *= worth;
    p.lost_alone *= worth;
    p.switching_price *= worth;
    int vehicle = 0;
    for (const auto& request : context.requests)
      p.gains(vehicle++, 0) -= price(request, context.now);
    for (const auto& session : context.sessions)
      p.gains(vehicle++, 0) -= price(session, context.now);
    const auto flow = min_cost_flow(p);
    auto all =
        decisions_of(context, asked, flow ? *flow : branch_and_bound(p).best);
    for (vehicle = 0; vehicle < p.vehicles(); ++vehicle)
      if (!terms_of(all[vehicle]) && p.gains(vehicle, 0) <= 0)
        all[vehicle].why = "late too often";
    std::erase_if(services_, [&](const auto& known) {
      return known.second.told < context.now && known.second.debt <= 0;
    });
    return all;
  }

  void observe(const episode_outcome& outcome) override {
    const auto i =
        services_.find({outcome.station, std::string{outcome.service}});
    if (i == services_.end())
      return;
    auto& service = i->second;
    const auto period_s = to_seconds(service.period);
    service.cycles += std::max(1.0, outcome.remote_s / period_s);
    if (outcome.end_reason == "qos_latency"
        || outcome.end_reason == "qos_input_age"
        || outcome.end_reason == "qos_gap"
        || outcome.end_reason == "implausible") {
      ++service.missed;
      ++service.debt;
    }
  }

  void visit_options(option_visitor& s) override {
    options_.visit_options(s);
    s.field("V", energy_weight_, {0, 1e9});
    s.field("violation_budget", budget_, {0, 1});
    s.field("unit_j", unit_j_, {0, 1e9});
  }
  double epoch_s() const override { return options_.epoch_s; }
  std::string_view name() const override { return "drift_plus_penalty"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<least_debts>(*this);
  }

private:
  struct service {
    duration period{1};
    time_point told;   // up to when cycles have paid off the debt
    double debt = 0;   // Z, cycles
    double cycles = 0; // that ran here,
    double missed = 0; // of these
  };

  /// @returns Z p̂ of a service now. Each cycle pays ε, wherever it is planned.
  template <class View>
  double price(const View& view, time_point now) {
    auto [i, is_new] =
        services_.try_emplace({view.station, std::string{view.service}});
    auto& service = i->second;
    service.period = view.task.period;
    if (!is_new)
      service.debt -=
          budget_ * to_seconds(now - service.told) / to_seconds(service.period);
    service.debt = std::max(service.debt, 0.0);
    service.told = now;
    return service.cycles > 0 ? service.debt * service.missed / service.cycles
                              : 0;
  }

  assignment::assignment_options options_;
  double energy_weight_ = 50; // V, 1/J
  double budget_ = 0.01;      // ε
  double unit_j_ = 0.027;
  std::map<std::pair<station_id, std::string>, service> services_;
};

} // namespace

codm_entry codm_drift_plus_penalty() {
  return {{"drift_plus_penalty",
           "Serves those who win most, but for who was late here too often.",
           "as assignment, with V unit_j g - Z P(missed here) for the gain of "
           "being here; Z <- [Z + missed - violation_budget]+ of each service",
           "as assignment; when offloadings ended, and why",
           "Neely, Stochastic Network Optimization, 2010, chapter 4",
           {{"epoch_s", "s", "that requests wait for each other"},
            {"price", "1", "of a change, in units of gains"},
            {"wait", "time", "for a worker that a result may have in the mean"},
            {"V", "1/J", "what energy counts beside debts"},
            {"violation_budget", "1", "missed cycles per cycle"},
            {"unit_j", "J", "what a gain of 1 counts as: a cycle on board"}}},
          filtered_by_request<least_debts>};
}

} // namespace sofof::policies
