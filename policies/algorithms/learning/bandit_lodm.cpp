// A bandit as the decision of a vehicle.
#include "policies/algorithms/learning/bandit_lodm.hpp"

#include "policies/algorithms/learning/state_text.hpp"

#include <algorithm>
#include <utility>

namespace sofof::policies {

namespace {

constexpr std::string_view text_kind = "trials";
constexpr std::uint64_t text_version = 1;

bool is_offered(const local_context& context, service_place place) {
  return !place || place == context.current
         || std::ranges::find(context.providers, *place, &provider_view::id)
                != context.providers.end();
}

} // namespace

bandit_lodm& bandit_lodm::operator=(const bandit_lodm& other) {
  if (this == &other)
    return *this;
  learning_ = other.learning_;
  learned_from_ = other.learned_from_;
  trial_ = other.trial_;
  epoch_s_ = other.epoch_s_;
  trials_.clear();
  shared_ = other.shared_;
  if (learning_)
    return *this;
  const std::lock_guard lock{other.shared_->busy};
  shared_ = std::make_shared<shared_bandits>();
  for (const auto& [name, learner] : other.shared_->all)
    shared_->all.emplace(name, learner->clone());
  return *this;
}

/// Called by whoever has the lock, as all that are not public.
bandit& bandit_lodm::learner_of(std::string_view name) const {
  auto& all = shared_->all;
  auto i = all.find(name);
  if (i == all.end())
    i = all.emplace(name, make_bandit()).first;
  return *i->second;
}

bandit_trial& bandit_lodm::trial_of(std::string_view name) {
  auto i = trials_.find(name);
  if (i == trials_.end())
    i = trials_.emplace(name, bandit_trial{}).first;
  return i->second;
}

bandit_trial* bandit_lodm::running(std::string_view name, service_place place) {
  auto& now = trial_of(name);
  return now.is_open() && now.place() == place ? &now : nullptr;
}

void bandit_lodm::conclude(std::string_view name, time_point now) {
  auto& was = trial_of(name);
  if (was.is_open() && (was.mean() || was.lasted(trial_, now)))
    learner_of(name).learn(was.place(), was.mean());
  was.close();
}

local_decision bandit_lodm::decide(const local_context& context) {
  const std::lock_guard lock{shared_->busy};
  auto& now = trial_of(context.service);
  if (now.is_open() && !now.lasted(trial_, context.now)
      && is_offered(context, now.place()))
    return at_place(context.current, now.place(), "on trial");
  conclude(context.service, context.now);
  const auto chosen = learner_of(context.service).choose(context);
  if (!chosen)
    return at_place(context.current, context.current,
                    "nobody comes into question");
  now = {chosen->place, context.now};
  return at_place(context.current, chosen->place, "on trial");
}

void bandit_lodm::observe(const cycle_outcome& outcome) {
  const std::lock_guard lock{shared_->busy};
  auto& now = trial_of(outcome.service);
  if (!now.is_open())
    return;
  if (const auto value =
          learner_of(outcome.service).value(outcome, now.place()))
    now.add(*value, outcome.cycles);
}

void bandit_lodm::observe(const refusal_outcome& outcome) {
  const std::lock_guard lock{shared_->busy};
  auto* now = running(outcome.service, outcome.provider);
  if (!now)
    return;
  learner_of(outcome.service).learn(outcome.provider, std::nullopt);
  now->close();
}

void bandit_lodm::observe(const episode_outcome& outcome) {
  const std::lock_guard lock{shared_->busy};
  auto* now = running(outcome.service, outcome.provider);
  if (!now)
    return;
  if (now->mean())
    learner_of(outcome.service).learn(outcome.provider, now->mean());
  now->close();
}

std::string bandit_lodm::snapshot() const {
  const std::lock_guard lock{shared_->busy};
  state_writer out{text_kind, text_version};
  out.word("services").count(shared_->all.size());
  std::string parts;
  for (const auto& [name, learner] : shared_->all) {
    const auto part = learner->snapshot();
    out.line().word(name).word("bytes").count(part.size());
    parts += part;
  }
  return out.text() + parts;
}

std::optional<std::string> bandit_lodm::restore(std::string_view text) {
  state_reader in{text, text_kind, text_version};
  in.expect("services");
  std::vector<std::pair<std::string, std::size_t>> parts;
  for (auto left = in.count(); left > 0 && !in.failed(); --left) {
    const auto name = in.word();
    in.expect("bytes");
    parts.emplace_back(name, in.count());
  }
  auto rest = in.after_end();
  if (in.failed())
    return in.fault();
  rest.remove_prefix(std::min<std::size_t>(rest.size(), 1)); // the line's end
  bandits read;
  for (const auto& [name, bytes] : parts) {
    auto learner = make_bandit();
    if (const auto fault =
            learner->restore(placed_in(text, rest.substr(0, bytes))))
      return name + ": " + *fault;
    rest.remove_prefix(std::min(rest.size(), bytes));
    read.emplace(name, std::move(learner));
  }
  if (!rest.empty())
    return "expected nothing more after the last service.";
  const std::lock_guard lock{shared_->busy};
  shared_->all = std::move(read);
  trials_.clear();
  return std::nullopt;
}

void bandit_lodm::visit_options(option_visitor& s) {
  s.field("learning", learning_);
  s.field("snapshot", learned_from_.file); // whoever loads it restores it
  s.field("trial", trial_, std::chrono::milliseconds{1});
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

std::vector<option_info> trials_and(const std::vector<option_info>& others) {
  std::vector<option_info> all{
      {"learning", "true or false",
       "all vehicles of a run share what they learn"},
      {"snapshot", "file",
       "what it begins with, of sofof train; empty: nothing"},
      {"trial", "time", "so long it stays with a choice"},
      {"epoch_s", "s", "between two looks"}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

} // namespace sofof::policies
