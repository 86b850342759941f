// LODM "greedy_gain": goes where a cycle costs least, now.
#include "policies/api/weights.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Asks the provider of the greatest gain, if that is more than the margin;
/// changes to another one that is better by as much, and comes home when
/// nothing is gained any more.
class greedy_gain final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    const auto* here = where_it_runs(context);
    const auto kept = here ? gain_of(*here, context) : 0;
    const auto is_gone = here && !(kept >= 0); // nor what is no number
    const provider_view* best = nullptr;
    auto most = (is_gone ? 0 : kept) + margin_;
    std::optional<double> offered; // at most
    for (const auto& provider : context.providers) {
      const auto won = gain_of(provider, context);
      if (!(offered >= won))
        offered = won;
      if (won > most && provider.id != context.current) {
        best = &provider;
        most = won;
      }
    }
    if (is_gone && !best)
      return at_place(context.current, std::nullopt, "the gain has gone");
    if (!best)
      return at_place(context.current, context.current,
                      here ? reason{"the gain goes on"}
                      : offered
                          ? reason{"too little is gained", *offered, margin_}
                          : reason{"too little is gained"});
    return {run_at{.provider = best->id, .advantage = most - kept},
            "the greatest gain"};
  }
  void visit_options(option_visitor& s) override {
    s.field("margin", margin_, {0, 1e3});
    list_weights(s, weights_);
    s.field("epoch_s", epoch_s_, {1e-3, 3600});
  }
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "greedy_gain"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<greedy_gain>(*this);
  }

private:
  double gain_of(const provider_view& provider,
                 const local_context& context) const {
    return gain(provider, context.on_board, context.needs, weights_);
  }

  double margin_ = 0.05;
  cost_weights weights_;
  double epoch_s_ = 0.1;
};

} // namespace

lodm_entry lodm_greedy_gain() {
  return {
      {"greedy_gain", "Goes where a cycle costs least, now.",
       "max g > margin; g = K_0 - K, K = lambda_T T / limit + lambda_E E / "
       "E_0 + lambda_V P(T > limit); home when g < 0",
       "latency and energy of a cycle here and there, the forecast of late "
       "results",
       "Chen et al., IEEE/ACM ToN 24(5), 2016, eqs. (4), (8), for the cost; "
       "the risk is ours",
       weights_and({{"margin", "1", "gain that is worth a change"},
                    {"epoch_s", "s", "between two decisions"}})},
      filtered_by_provider<greedy_gain>};
}

} // namespace sofof::policies
