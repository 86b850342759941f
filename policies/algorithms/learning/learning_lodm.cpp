// A learner as the decision of a vehicle.
#include "policies/algorithms/learning/learning_lodm.hpp"

#include "policies/algorithms/learning/snapshot_file.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace sofof::policies {

namespace {

/// After so many epochs without a decision nobody was there to go to.
constexpr int longest_step_epochs = 5;

bool is_there(const local_context& context, provider_id place) {
  return std::ranges::find(context.providers, place, &provider_view::id)
         != context.providers.end();
}

} // namespace

learning_lodm::learning_lodm(make_q_function make, const learner_options& how,
                             std::string_view frozen)
    : make_{make}, frozen_{frozen} {
  options_.how = how;
  renew_mind();
}

learning_lodm::learning_lodm(const learning_lodm& other)
    : local_policy{}, make_{other.make_}, frozen_{other.frozen_},
      options_{other.options_},
      learned_from_{other.learned_from_}, shared_{other.shared_} {
  if (options_.learning)
    return;
  const std::lock_guard lock{other.shared_->busy};
  shared_ = std::make_shared<shared_learner>();
  shared_->taught = other.shared_->taught->clone();
}

void learning_lodm::renew_mind() {
  shared_ = std::make_shared<shared_learner>();
  shared_->taught = make_(options_.how);
  learned_from_.shape = shared_->taught->shape();
  if (options_.learning || frozen_.empty())
    return;
  if (const auto fault = shared_->taught->restore(learned_in(frozen_)))
    throw std::logic_error{"a snapshot that came with the program: " + *fault};
}

learning_lodm::service& learning_lodm::of(std::string_view name) {
  auto i = services_.find(name);
  if (i == services_.end())
    i = services_.emplace(name, service{}).first;
  return i->second;
}

mind_state learning_lodm::look(const local_context& context,
                               const provider_view& provider,
                               bool is_remote) const {
  return mind_state{
      offloading_view{context, provider, is_remote, options_.radius_m}};
}

std::optional<learning_lodm::way_out>
learning_lodm::best_way_out(const local_context& context) {
  std::optional<way_out> best;
  for (const auto& provider : context.providers) {
    if (provider.id == context.current)
      continue;
    const auto state = look(context, provider, false);
    const auto pays = shared_->taught->change_pays(state);
    if (!best || pays > best->pays)
      best = way_out{provider.id, state, pays};
  }
  return best;
}

local_decision learning_lodm::decide(const local_context& context) {
  const std::lock_guard lock{shared_->busy};
  auto& seen = of(context.service);
  seen.reference_j = context.on_board.energy_j;
  if (seen.open) {
    const auto lasted = context.now - seen.open->begin;
    const auto epoch = from_seconds(options_.epoch_s);
    if (lasted < epoch)
      return at_place(context.current, context.current, "not yet");
    if (lasted > longest_step_epochs * epoch)
      conclude(seen, std::nullopt);
  }
  const auto other = best_way_out(context);
  if (context.current && is_there(context, *context.current)) {
    const auto state = look(context, *where_it_runs(context), true);
    if (act(seen, context, state) == to_keep)
      return at_place(context.current, context.current,
                      "learned to stay there");
    return other && other->pays > 0
               ? at_place(context.current, other->place, "learned to go on")
               : at_place(context.current, std::nullopt,
                          "learned to come home");
  }
  if (context.current)
    conclude(seen, std::nullopt);
  if (!other || act(seen, context, other->state) == to_keep)
    return at_place(context.current, context.current, "learned to stay");
  return at_place(context.current, other->place, "learned to go there");
}

std::size_t learning_lodm::act(service& seen, const local_context& context,
                               const mind_state& state) {
  auto& taught = *shared_->taught;
  if (!options_.learning)
    return taught.change_pays(state) > 0 ? to_change : to_keep;
  conclude(seen, state);
  const auto action = taught.explore(state);
  seen.open = step{state, action, context.now};
  seen.open->changes = action == to_change ? 1 : 0;
  return action;
}

void learning_lodm::conclude(service& seen,
                             const std::optional<mind_state>& next) {
  const auto was = std::exchange(seen.open, std::nullopt);
  if (!was || !(was->cycles > 0))
    return;
  const auto cost = was->cost / was->cycles;
  shared_->taught->learn({was->state, was->action,
                          -cost - options_.switch_weight * was->changes, next});
}

void learning_lodm::observe(const cycle_outcome& outcome) {
  if (!options_.learning)
    return;
  auto& seen = of(outcome.service);
  if (!seen.open)
    return;
  auto cost = outcome.missed ? options_.violation_weight : 0;
  if (seen.reference_j > 0)
    cost += options_.energy_weight * outcome.energy_j / seen.reference_j;
  seen.open->cost += cost * outcome.cycles;
  seen.open->cycles += outcome.cycles;
}

void learning_lodm::observe(const episode_outcome& outcome) {
  if (!options_.learning)
    return;
  constexpr std::array<std::string_view, 2> wanted{"released", "handed_over"};
  constexpr std::array<std::string_view, 2> over{"left_area", "shutdown"};
  const std::lock_guard lock{shared_->busy};
  auto& seen = of(outcome.service);
  if (std::ranges::find(over, outcome.end_reason) != over.end())
    conclude(seen, std::nullopt);
  else if (seen.open
           && std::ranges::find(wanted, outcome.end_reason) == wanted.end())
    ++seen.open->changes;
}

std::string learning_lodm::snapshot() const {
  const std::lock_guard lock{shared_->busy};
  return shared_->taught->snapshot();
}

std::optional<std::string> learning_lodm::restore(std::string_view text) {
  const std::lock_guard lock{shared_->busy};
  return shared_->taught->restore(text);
}

void learning_lodm::visit_options(option_visitor& s) {
  const auto learned = options_.learning;
  const auto how = options_.how;
  s.field("learning", options_.learning);
  s.field("snapshot", learned_from_.file); // whoever loads it restores it
  s.field("discount", options_.how.discount, {0, 1});
  s.field("explore_first", options_.how.explore.first, {0, 1});
  s.field("explore_last", options_.how.explore.last, {0, 1});
  auto decisions = static_cast<std::int64_t>(options_.how.explore.decisions);
  s.field("explore_decisions", decisions, {1, 1e12});
  options_.how.explore.decisions = static_cast<std::uint64_t>(decisions);
  s.field("energy_weight", options_.energy_weight, {0, 1e3});
  s.field("violation_weight", options_.violation_weight, {0, 1e3});
  s.field("switch_weight", options_.switch_weight, {0, 1e3});
  s.field("radius_m", options_.radius_m, {0, 1e6});
  s.field("epoch_s", options_.epoch_s, {1e-3, 3600});
  if (options_.learning != learned || options_.how != how)
    renew_mind();
}

std::vector<option_info> learning_notes() {
  return {
      {"learning", "true or false",
       "from its snapshot on, or from nothing, all vehicles together"},
      {"snapshot", "file",
       "what it has learned, of sofof train; empty: what came along, if it "
       "does not learn"},
      {"discount", "1", "of the next step's reward, while learning"},
      {"explore_first", "1", "share of random decisions at first"},
      {"explore_last", "1", "and from so many decisions on:"},
      {"explore_decisions", "decisions", "from first to last"},
      {"energy_weight", "1", "lambda_E, of energy in parts of that on board"},
      {"violation_weight", "1", "lambda_V, of a missed cycle"},
      {"switch_weight", "1", "lambda_S, of a change"},
      {"radius_m", "m", "of the area round a provider"},
      {"epoch_s", "s", "of a step"}};
}

} // namespace sofof::policies
