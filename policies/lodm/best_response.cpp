// LODM "best_response": the offloading game, as one vehicle sees it.
#include "policies/algorithms/game/channel_model.hpp"
#include "policies/api/weights.hpp"
#include "policies/entry.hpp"

#include <algorithm>

namespace sofof::policies {

namespace {

/// Those at a provider share its workers alike; the more there are the longer
/// each result takes. In each slot who would save more than the margin by going
/// elsewhere does so with a probability: no referee grants the moves, so this
/// keeps many from moving at once.
class best_response final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    const auto* here = where_it_runs(context);
    const auto at_home = weighed(context.on_board, 0, context.needs,
                                 context.on_board.energy_j, weights_);
    const auto kept = here ? cost_at(*here, context) : at_home;
    auto best = context.current;
    auto least = kept - margin_;
    const auto consider = [&](service_place place, double cost) {
      if (place == context.current || !(cost < least))
        return;
      best = place;
      least = cost;
    };
    consider(std::nullopt, at_home);
    for (const auto& provider : context.providers)
      consider(provider.id, cost_at(provider, context));
    if (best == context.current)
      return at_place(context.current, best, "no better response");
    if (context.noise.uniform(context.number) > probability_)
      return at_place(context.current, context.current, "lost the lottery");
    auto decision = at_place(context.current, best, "the best response");
    if (auto* there = std::get_if<run_at>(&decision.what))
      there->advantage = kept - least;
    return decision;
  }
  void visit_options(option_visitor& s) override {
    s.field("margin", margin_, {0, 1e3});
    s.field("probability", probability_, {0, 1});
    list_weights(s, weights_);
    s.field("slot_s", slot_s_, {1e-3, 3600});
  }
  double epoch_s() const override { return slot_s_; }
  std::string_view name() const override { return "best_response"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<best_response>(*this);
  }

private:
  /// What a cycle there costs once it runs there.
  double cost_at(const provider_view& provider,
                 const local_context& context) const {
    auto cost = provider.cost;
    cost.time_s += computing_s(provider, context);
    return weighed(cost, provider.link.late, context.needs,
                   context.on_board.energy_j, weights_);
  }

  /// By contention, each with the weight of what it asks of one worker. Nobody
  /// computes one result on more than one worker.
  static double computing_s(const provider_view& provider,
                            const local_context& context) {
    const auto workers =
        static_cast<double>(std::max<std::size_t>(provider.workers, 1));
    const auto period_s = to_seconds(context.needs.period);
    if (!(provider.computing_s > 0 && period_s > 0))
      return provider.computing_s;
    const auto own = provider.computing_s / period_s;
    auto others = provider.utilisation * workers;
    if (provider.id == context.current)
      others -= own;
    game::player self;
    self.lone_rate_bps = workers / provider.computing_s; // a bit is a result
    self.contention_weight = own;
    const auto results_per_s =
        game::contention{}.rate_bps(self, std::max(others, 0.0));
    const auto shared_s = 1 / results_per_s;
    return shared_s <= provider.computing_s ? provider.computing_s : shared_s;
  }

  double margin_ = 0.02;
  double probability_ = 0.2;
  cost_weights weights_;
  double slot_s_ = 0.5;
};

} // namespace

lodm_entry lodm_best_response() {
  return {
      {"best_response",
       "Moves where its own cycles cost less, among others who do likewise.",
       "K(a) < K(now) - margin, with a probability per slot; K as of "
       "greedy_gain, T = way + S max(1, (w + W) / (w workers)), w its own "
       "load and W that of the others there",
       "utilisation and workers of providers, time and energy of a cycle "
       "here and there, the forecast of late results",
       "Chen et al., IEEE/ACM ToN 24(5), 2016, eq. (30); without its "
       "referee",
       weights_and({{"margin", "1", "cost that a move must save"},
                    {"probability", "1", "to move in a slot"},
                    {"slot_s", "s", "between two decisions"}})},
      filtered_by_provider<best_response>};
}

} // namespace sofof::policies
