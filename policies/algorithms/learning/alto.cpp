// A bandit for providers that come and go and tasks of different sizes.
#include "policies/algorithms/learning/alto.hpp"

#include "policies/algorithms/learning/state_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace sofof::policies {

namespace {

constexpr std::string_view alto_text = "alto";
constexpr std::uint64_t alto_version = 1;

} // namespace

std::optional<provider_id> alto::choose(double task_bits,
                                        std::span<const provider_id> present) {
  assert(task_bits > 0);
  ++tasks_;
  std::optional<std::pair<double, provider_id>> best;
  for (const auto provider : present) {
    const auto known =
        known_.try_emplace(provider, record{tasks_, 0, 0}).first->second;
    const std::pair candidate{promise(known, task_bits), provider};
    if (!best || candidate < *best)
      best = candidate;
  }
  if (!best)
    return std::nullopt;
  return best->second;
}

double alto::promise(const record& known, double task_bits) const {
  if (known.results == 0)
    return -std::numeric_limits<double>::infinity();
  const auto size =
      std::clamp((task_bits - options_.small_bits)
                     / (options_.large_bits - options_.small_bits),
                 0.0, 1.0);
  const auto age =
      static_cast<double>(std::max<std::uint64_t>(tasks_ - known.appeared, 1));
  const auto results = static_cast<double>(known.results);
  return known.mean_delay
         - std::sqrt(options_.beta * (1 - size) * std::log(age) / results);
}

void alto::learn(provider_id provider, double task_bits, double delay_s) {
  assert(task_bits > 0);
  const auto found = known_.find(provider);
  if (found == known_.end())
    return;
  auto& known = found->second;
  const auto delay =
      std::min(delay_s / task_bits / options_.worst_delay_s_per_bit, 1.0);
  ++known.results;
  known.mean_delay +=
      (delay - known.mean_delay) / static_cast<double>(known.results);
}

std::string alto::snapshot() const {
  state_writer out{alto_text, alto_version};
  out.word("worst").number(options_.worst_delay_s_per_bit).line();
  out.word("tasks").count(tasks_).word("providers").count(known_.size());
  for (const auto& [provider, known] : known_)
    out.line()
        .count(provider.value())
        .count(known.appeared)
        .count(known.results)
        .number(known.mean_delay);
  return out.text();
}

std::optional<std::string> alto::restore(std::string_view snapshot) {
  state_reader in{snapshot, alto_text, alto_version};
  in.expect("worst");
  if (in.number() != options_.worst_delay_s_per_bit)
    in.refuse("expected the worst delay of this learner.");
  alto read{options_};
  in.expect("tasks");
  read.tasks_ = in.count();
  in.expect("providers");
  for (auto left = in.count(); left > 0 && !in.failed(); --left) {
    const provider_id provider = in.count(~provider_id::rep{0});
    record known;
    known.appeared = in.count(read.tasks_);
    known.results = in.count();
    known.mean_delay = in.number();
    if (known.mean_delay < 0 || known.mean_delay > 1)
      in.refuse("expected a mean delay from 0 to 1.");
    if (!in.failed() && !read.known_.emplace(provider, known).second)
      in.refuse("expected each provider once.");
  }
  in.expect_end();
  if (!in.failed())
    *this = std::move(read);
  return in.fault();
}

} // namespace sofof::policies
