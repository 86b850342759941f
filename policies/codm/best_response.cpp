// CODM "best_response": an equilibrium among all who ask and all who are
// served.
#include "policies/algorithms/game/best_response.hpp"

#include "base/options/option_helpers.hpp"
#include "policies/algorithms/game/provider_game.hpp"
#include "policies/api/central_view.hpp"
#include "policies/entry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace sofof::policies {

namespace {

constexpr std::array<std::string_view, 2> models{"contention", "interference"};

/// Bandwidth with which a lone player's rate is 1, as with contention.
std::shared_ptr<const game::channel_model> model_of(std::string_view name) {
  if (name == "contention")
    return std::make_shared<game::contention>();
  const auto per_hz = std::log2(1 + game::equal_power_w / game::noise_w);
  return std::make_shared<game::interference>(1 / per_hz, game::noise_w);
}

/// Plays from what is on, so that nobody leaves unless others crowd it out.
/// Who is crowded out before it began is told whom it would rather ask.
/// Source: Chen 2016, Algorithm 1.
class equilibrium final : public central_policy {
public:
  std::vector<central_decision> decide(const central_context& context) override;
  void visit_options(option_visitor& s) override;
  double epoch_s() const override { return options_.epoch_s; }
  std::string_view name() const override { return "best_response"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<equilibrium>(*this);
  }

private:
  central_options options_;
  std::string model_ = "contention";
};

/// @returns where a request would win most, and still finds room; nullopt:
/// nowhere.
std::optional<provider_id> best_other(const request_view& request,
                                      std::span<const other_provider> others) {
  std::optional<provider_id> best;
  double most = 0;
  for (const auto& other : others) {
    const auto gain = told_gain(request.candidates, other.id).value_or(0);
    if (gain > most && other.utilisation + request.utilisation <= 1) {
      best = other.id;
      most = gain;
    }
  }
  return best;
}

std::vector<central_decision>
equilibrium::decide(const central_context& context) {
  const auto begin = game::game_of(context, options_.price, model_of(model_));
  const auto lottery = context.noise.part("best response").part(context.number);
  const auto choices = play(begin.game, begin.now, lottery).choices;
  const auto others = others_told(context);
  std::vector<central_decision> all;
  for (const auto c : choices) {
    const auto asks = all.size() < context.requests.size();
    if (c != game::locally)
      all.push_back({accepted{.worker = c - 1}, "it pays"});
    else if (asks)
      all.push_back({refused{best_other(context.requests[all.size()], others)},
                     "too crowded"});
    else
      all.push_back({refused{}, "crowded out"});
  }
  return all;
}

void equilibrium::visit_options(option_visitor& s) {
  options_.visit_options(s);
  visit_word(s, "model", model_, "model", models);
}

} // namespace

codm_entry codm_best_response() {
  return {{"best_response",
           "Serves those whom it pays beside the others, one worker each.",
           "moves of single players to their best choice until nobody gains "
           "by one; cost alone a = 0.3 S / limit, with n others a (n + 1) "
           "(contention) or a log2(1 + 100) / log2(1 + 1 / (0.01 + n)) "
           "(interference)",
           "the gains that vehicles tell with requests, what runs, computing "
           "times",
           "Chen, Jiao, Li & Fu, ToN 24(5), 2016",
           {{"epoch_s", "s", "that requests wait for each other"},
            {"price", "1", "of a change, in units of gains"},
            {"model", "\"contention\" or \"interference\"",
             "of those who share a worker"}}},
          filtered_by_request<equilibrium>};
}

} // namespace sofof::policies
