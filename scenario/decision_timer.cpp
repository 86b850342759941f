// Watches beside policies.
#include "scenario/decision_timer.hpp"

#include <fmt/format.h>

namespace sofof::scenario {

namespace {

template <class... Parts>
std::shared_ptr<decision_times>
add_timer(std::shared_ptr<policies::policy<Parts...>>& policy) {
  auto times = std::make_shared<decision_times>();
  policy = std::make_shared<timed_policy<Parts...>>(policy->clone(), times);
  return times;
}

void add_figures(std::vector<std::pair<std::string, double>>& to,
                 std::string_view side, const decision_times& times) {
  constexpr double us_per_ms = 1000;
  const auto x = times.so_far();
  if (x.ms().count() == 0)
    return;
  to.emplace_back(fmt::format("{}_decisions", side), x.ms().count());
  const auto time = [&](std::string_view what, double ms) {
    to.emplace_back(fmt::format("{}_decide_{}_us", side, what), us_per_ms * ms);
  };
  time("mean", x.ms().mean().value());
  time("p50", x.quantile_ms(0.5).value());
  time("p99", x.quantile_ms(0.99).value());
  time("max", x.ms().max().value());
}

} // namespace

void decision_times::add(duration d) {
  const std::lock_guard lock{mutex_};
  times_.add(d);
}

distribution decision_times::so_far() const {
  const std::lock_guard lock{mutex_};
  return times_;
}

std::vector<std::pair<std::string, double>> deciding_times::figures() const {
  std::vector<std::pair<std::string, double>> all;
  add_figures(all, "lodm", *lodm);
  add_figures(all, "codm", *codm);
  return all;
}

deciding_times add_timers(policy_options& policies) {
  return {add_timer(policies.lodm), add_timer(policies.codm)};
}

} // namespace sofof::scenario
