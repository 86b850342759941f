// Governor "redundancy": two providers plan the same cycles.
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Who waits for a result longer than that waits in vain.
constexpr duration longest_hedge = std::chrono::seconds{10};

/// Where a service runs at one provider, or shall, has another one run it too:
/// of those that come into question the one that is late least often. Of each
/// cycle the first result is used.
/// Source: Dean & Barroso, The Tail at Scale, CACM 56(2), 2013.
class redundancy_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "redundancy"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<redundancy_governor>(*this);
  }

private:
  double least_late_ = 0;  // below this one provider is enough
  duration hedge_after_{}; // 0: the other one plans every cycle
};

local_decision redundancy_governor::govern(const local_context& context,
                                           const local_decision& wanted) {
  if (std::holds_alternative<come_home>(wanted.what))
    return wanted;
  const auto* there = std::get_if<run_at>(&wanted.what);
  const auto first = there ? there->provider : context.current;
  if (!first)
    return wanted;
  const provider_view* best = nullptr;
  bool is_enough = false;
  for (const auto& other : context.providers) {
    if (other.id == first)
      is_enough = other.link.late < least_late_;
    else if (!best || other.link.late < best->link.late)
      best = &other;
  }
  if (best && !is_enough)
    return with_second(wanted, second_provider{best->id, hedge_after_});
  return there ? wanted // a second one that it does not ask for ends
               : local_decision{run_at{*first, second_of(wanted)}, wanted.why};
}

void redundancy_governor::visit_options(option_visitor& s) {
  s.field("least_late", least_late_, {0, 1});
  s.field("hedge_after", hedge_after_, duration{0});
  if (hedge_after_ > longest_hedge)
    s.refuse("hedge_after", "must not be more than \"10s\".");
}

} // namespace

governor_entry governor_redundancy() {
  return {
      {"redundancy",
       "Two providers plan the same cycles; the first result is used.",
       "with another one of least P(latency > limit), if that of the first is "
       "not below least_late",
       "latencies of what came from each provider",
       "Dean & Barroso, CACM 56(2), 2013",
       {{"least_late", "1",
         "probability to be late below which one provider is enough"},
        {"hedge_after", "time",
         "the second plans only cycles that the first has not answered for so "
         "long, well below max_interarrival - period, at most \"10s\"; 0: "
         "all"}}},
      unfiltered<governor, redundancy_governor>};
}

} // namespace sofof::policies
