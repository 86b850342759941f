// Governor "rss": offloads only while the scene is safe under the response time
// that this may lead to.
#include "policies/entry.hpp"

#include <chrono>
#include <string_view>
#include <variant>

namespace sofof::policies {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view not_safe = "not safe under its response time";

/// A service goes to a provider, or from one to another, only with a margin,
/// and comes home before the scene is not safe any more.
class rss_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  double epoch_s() const override { return epoch_s_; }
  bool needs_scene() const override { return true; }
  bool foresees_home(const local_context& context) const override {
    return context.safe_response && !leaves(context, enter_margin_);
  }
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "rss"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<rss_governor>(*this);
  }

private:
  /// @returns whether the scene leaves so much more than the worst response.
  static bool leaves(const local_context& context, duration margin) {
    const auto worst = context.needs.worst_response;
    return worst < duration::max() - margin
           && *context.safe_response >= worst + margin;
  }

  duration enter_margin_ = 300ms;
  duration leave_margin_ = 100ms;
  double epoch_s_ = 0.05;
};

local_decision rss_governor::govern(const local_context& context,
                                    const local_decision& wanted) {
  if (!context.safe_response || std::holds_alternative<come_home>(wanted.what))
    return wanted;
  if (leaves(context, enter_margin_))
    return wanted;
  const reason why{not_safe, to_seconds(*context.safe_response),
                   to_seconds(context.needs.worst_response), "s"};
  if (context.current && !leaves(context, leave_margin_))
    return {come_home{}, why};
  const auto* there = std::get_if<run_at>(&wanted.what);
  // No decision is made while it moves, so there must be time for that.
  const auto moves = there ? there->provider != context.current
                           : !context.current && second_of(wanted);
  return moves ? as_it_is(why) : wanted;
}

void rss_governor::visit_options(option_visitor& s) {
  s.field("enter_margin", enter_margin_, duration{0});
  s.field("leave_margin", leave_margin_, duration{0});
  if (enter_margin_ < leave_margin_)
    s.refuse("enter_margin", "must not be less than `leave_margin`.");
  s.field("epoch_s", epoch_s_, {1e-3, 3600});
  if (to_seconds(leave_margin_) < epoch_s_)
    s.refuse("leave_margin", "must not be less than `epoch_s`.");
}

} // namespace

governor_entry governor_rss() {
  return {
      {"rss",
       "Offloads only while the scene is safe under the response time.",
       "longest safe response >= max_input_age + max_interarrival + first own "
       "result + margin",
       "the longest response time under which the vehicle's scene is safe",
       "Dehler et al., arXiv 2606.07067, for the idea; the time by "
       "Shalev-Shwartz et al., arXiv 1708.06374",
       {{"enter_margin", "time", "more is safe before a provider is asked"},
        {"leave_margin", "time", "and before the service comes home"},
        {"epoch_s", "s", "between two looks"}}},
      unfiltered<governor, rss_governor>};
}

} // namespace sofof::policies
