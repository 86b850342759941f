// A bandit that tries what is promising or little known.
#include "policies/algorithms/learning/ucb1.hpp"

#include "policies/algorithms/learning/state_text.hpp"

#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

constexpr std::string_view ucb1_text = "ucb1";
constexpr std::uint64_t ucb1_version = 1;

} // namespace

std::optional<std::size_t> ucb1::choose(action_set allowed) const {
  const auto width = 2 * std::log(static_cast<double>(pulls_));
  std::optional<std::size_t> best;
  double best_worth = 0;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    if (!allowed[i])
      continue;
    if (arms_[i].pulls == 0)
      return i;
    const auto pulls = static_cast<double>(arms_[i].pulls);
    const auto worth = arms_[i].total / pulls + std::sqrt(width / pulls);
    if (!best || worth > best_worth) {
      best = i;
      best_worth = worth;
    }
  }
  return best;
}

void ucb1::learn(std::size_t arm, double reward) {
  assert(arm < arms_.size());
  arms_[arm].total += reward;
  ++arms_[arm].pulls;
  ++pulls_;
}

std::string ucb1::snapshot() const {
  state_writer out{ucb1_text, ucb1_version};
  out.word("arms").count(arms_.size());
  for (const auto& arm : arms_)
    out.line().number(arm.total).count(arm.pulls);
  return out.text();
}

std::optional<std::string> ucb1::restore(std::string_view snapshot) {
  state_reader in{snapshot, ucb1_text, ucb1_version};
  in.expect("arms", arms_.size());
  ucb1 read{arms_.size()};
  for (auto& arm : read.arms_) {
    arm.total = in.number();
    arm.pulls = in.count();
    if (arm.total < 0 || arm.total > static_cast<double>(arm.pulls))
      in.refuse("expected rewards from 0 to 1.");
    read.pulls_ += arm.pulls;
  }
  in.expect_end();
  if (!in.failed())
    *this = read;
  return in.fault();
}

} // namespace sofof::policies
