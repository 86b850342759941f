// Governor "redundancy": two providers plan the same cycles.
#include "policies/governors/redundancy_governor.hpp"

namespace sofof {

namespace {

/// Who waits for a result longer than that waits in vain.
constexpr duration longest_hedge = std::chrono::seconds{10};

} // namespace

local_decision redundancy_governor::govern(const local_context& context,
                                           const local_decision& wanted) {
  auto decision = wanted;
  const auto first = wanted.source != 0 ? wanted.source : context.current;
  if (wanted.release || first == 0)
    return decision;
  const provider_view* best = nullptr;
  bool is_enough = false;
  for (const auto& other : context.providers) {
    if (other.id == first)
      is_enough = other.link.late < least_late_;
    else if (!best || other.link.late < best->link.late)
      best = &other;
  }
  if (best && !is_enough) {
    decision.second = best->id;
    decision.hedge_after = hedge_after_;
  } else {
    decision.source = first; // alone: a second one ends
  }
  return decision;
}

void redundancy_governor::visit_options(option_visitor& s) {
  s.field("least_late", least_late_, {0, 1});
  s.field("hedge_after", hedge_after_, duration{0});
  if (hedge_after_ > longest_hedge)
    s.refuse("hedge_after", "must not be more than \"10s\".");
}

} // namespace sofof
