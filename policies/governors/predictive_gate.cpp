// Governor "predictive_gate": offloads only where results will be in time.
#include "policies/algorithms/forecast/predictive_gate.hpp"

#include "policies/entry.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::policies {

namespace {

constexpr std::string_view late_results = "late results are likely";

/// A gate for each service and provider on the forecast that its next result is
/// late. A provider whose gate is closed is not asked, and a service that runs
/// there comes home, unless it has just begun and there is no forecast yet.
class predictive_gate_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  double epoch_s() const override { return epoch_s_; }
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "predictive_gate"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<predictive_gate_governor>(*this);
  }

private:
  bool open(const local_context& context, const provider_view& provider);

  double on_ = 0.005;
  double off_ = 0.02;
  double epoch_s_ = 0.1;
  std::map<std::pair<std::string, provider_id>, predictive_gate> gates_;
};

bool predictive_gate_governor::open(const local_context& context,
                                    const provider_view& provider) {
  auto& gate =
      gates_.try_emplace({std::string{context.service}, provider.id}, on_, off_)
          .first->second;
  return gate.update(provider.link.late);
}

local_decision predictive_gate_governor::govern(const local_context& context,
                                                const local_decision& wanted) {
  auto ends = false; // where it runs
  std::vector<provider_id> closed;
  for (const auto& provider : context.providers) { // all gates look on
    if (open(context, provider))
      continue;
    closed.push_back(provider.id);
    ends = ends || (provider.id == context.current && provider.link.median);
  }
  const auto is_closed = [&](provider_id id) {
    return std::ranges::find(closed, id) != closed.end();
  };
  if (std::holds_alternative<come_home>(wanted.what))
    return ends ? local_decision{come_home{}, late_results} : wanted;
  auto second = second_of(wanted);
  if (second && is_closed(second->provider))
    second.reset();
  const auto* there = std::get_if<run_at>(&wanted.what);
  const auto moves = there && there->provider != context.current;
  if (moves && !is_closed(there->provider))
    return with_second(wanted, second);
  if (ends && !second)
    return {come_home{}, late_results};
  if (ends) // the other one is fine
    return {run_at{.provider = second->provider,
                   .advantage = there ? there->advantage : 1},
            wanted.why};
  return moves ? with_second(as_it_is(late_results), second)
               : with_second(wanted, second);
}

void predictive_gate_governor::visit_options(option_visitor& s) {
  s.field("on", on_, {0, 1});
  s.field("off", off_, {0, 1});
  if (off_ < on_)
    s.refuse("off", "must not be less than `on`.");
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

} // namespace

governor_entry governor_predictive_gate() {
  return {
      {"predictive_gate",
       "Offloads only where results will be in time.",
       "P(latency > limit) <= on to go there, > off to come home",
       "latencies of what came from each provider",
       "Wodtko et al., IV 2025, for the forecast; the gate is ours",
       {{"on", "1", "probability to be late up to which a provider is asked"},
        {"off", "1", "probability above which the service comes home"},
        {"epoch_s", "s", "between two looks"}}},
      unfiltered<governor, predictive_gate_governor>};
}

} // namespace sofof::policies
