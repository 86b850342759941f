// Governor "predictive_gate": offloads only where results will be in time.
#include "policies/governors/predictive_gate_governor.hpp"

namespace sofof {

namespace {

constexpr std::string_view late_results = "late results are likely";

} // namespace

bool predictive_gate_governor::open(const local_context& context,
                                    const provider_view& provider) {
  auto& gate =
      gates_.try_emplace({std::string{context.kind}, provider.id}, on_, off_)
          .first->second;
  return gate.update(provider.link.late);
}

local_decision predictive_gate_governor::govern(const local_context& context,
                                                const local_decision& wanted) {
  auto decision = wanted;
  auto ends = false;                               // where it runs
  for (const auto& provider : context.providers) { // all gates look on
    if (open(context, provider))
      continue;
    const auto is_known = provider.link.median.has_value();
    ends = ends || (provider.id == context.current && is_known);
    if (provider.id == decision.second)
      decision.second = 0;
    if (provider.id == decision.source && provider.id != context.current)
      decision.source = 0;
  }
  const auto stays = decision.source == 0 || decision.source == context.current;
  if (stays && ends && decision.second == 0) {
    decision = as_it_is(late_results);
    decision.release = true;
  } else if (stays && ends) { // the other one is fine
    decision.source = decision.second;
    decision.second = 0;
  } else if (decision.source != wanted.source) {
    decision.why = late_results;
  }
  return decision;
}

void predictive_gate_governor::visit_options(option_visitor& s) {
  s.field("on", on_, {0, 1});
  s.field("off", off_, {0, 1});
  if (off_ < on_)
    s.refuse("off", "must not be less than `on`.");
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
}

} // namespace sofof
