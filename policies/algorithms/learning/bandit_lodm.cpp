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
  trial_ = other.trial_;
  epoch_s_ = other.epoch_s_;
  services_.clear();
  for (const auto& [name, tried] : other.services_)
    services_.emplace(name, service{tried.learner->clone(), {}});
  return *this;
}

bandit_lodm::service& bandit_lodm::of(std::string_view name) {
  auto i = services_.find(name);
  if (i == services_.end())
    i = services_.emplace(name, service{make_bandit(), {}}).first;
  return i->second;
}

bandit_trial* bandit_lodm::running(std::string_view name, service_place place) {
  auto& now = of(name).now;
  return now.is_open() && now.place() == place ? &now : nullptr;
}

void bandit_lodm::conclude(service& tried, time_point now) const {
  const auto& was = tried.now;
  if (was.is_open() && (was.mean() || was.lasted(trial_, now)))
    tried.learner->learn(was.place(), was.mean());
  tried.now.close();
}

local_decision bandit_lodm::decide(const local_context& context) {
  auto& tried = of(context.service);
  if (tried.now.is_open() && !tried.now.lasted(trial_, context.now)
      && is_offered(context, tried.now.place()))
    return at_place(context.current, tried.now.place(), "on trial");
  conclude(tried, context.now);
  const auto chosen = tried.learner->choose(context);
  if (!chosen)
    return at_place(context.current, context.current,
                    "nobody comes into question");
  tried.now = {chosen->place, context.now};
  return at_place(context.current, chosen->place, "on trial");
}

void bandit_lodm::observe(const cycle_outcome& outcome) {
  auto& tried = of(outcome.service);
  if (!tried.now.is_open())
    return;
  if (const auto value = tried.learner->value(outcome, tried.now.place()))
    tried.now.add(*value, outcome.cycles);
}

void bandit_lodm::observe(const refusal_outcome& outcome) {
  auto* now = running(outcome.service, outcome.provider);
  if (!now)
    return;
  of(outcome.service).learner->learn(outcome.provider, std::nullopt);
  now->close();
}

void bandit_lodm::observe(const episode_outcome& outcome) {
  auto* now = running(outcome.service, outcome.provider);
  if (!now)
    return;
  if (now->mean())
    of(outcome.service).learner->learn(outcome.provider, now->mean());
  now->close();
}

std::string bandit_lodm::snapshot() const {
  state_writer out{text_kind, text_version};
  out.word("services").count(services_.size());
  std::string parts;
  for (const auto& [name, tried] : services_) {
    const auto part = tried.learner->snapshot();
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
  services read;
  for (const auto& [name, bytes] : parts) {
    service tried{make_bandit(), {}};
    if (const auto fault = tried.learner->restore(rest.substr(0, bytes)))
      return name + ": " + *fault;
    rest.remove_prefix(std::min(rest.size(), bytes));
    read.emplace(name, std::move(tried));
  }
  if (!rest.empty())
    return "expected nothing more after the last service.";
  services_ = std::move(read);
  return std::nullopt;
}

void bandit_lodm::visit_options(option_visitor& s) {
  s.field("trial", trial_, std::chrono::milliseconds{1});
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

std::vector<option_info> trials_and(const std::vector<option_info>& others) {
  std::vector<option_info> all{
      {"trial", "time", "so long it stays with a choice"},
      {"epoch_s", "s", "between two looks"}};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

} // namespace sofof::policies
