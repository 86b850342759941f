// LODM "oracle": knows what will be late.
#include "policies/entry.hpp"

#include <tuple>

namespace sofof {

namespace {

/// Goes where nothing will be late for a while, and leaves just before the
/// first late result; to compare with, as nobody knows the future. It knows
/// what links do, not what others will ask for.
class oracle final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    if (!context.future)
      return at_place(context, context.current, "no foresight here");
    const auto soon = context.now + lookahead_;
    const auto* here = where_it_runs(context);
    if (here && good_until(context, *here) >= soon)
      return at_place(context, context.current, "nothing will be late here");
    if (const auto* best = best_elsewhere(context))
      return at_place(context, best->id, "nothing will be late there");
    if (!here)
      return as_it_is("something will be late");
    const auto next = context.now + from_seconds(epoch_s_);
    if (good_until(context, *here) <= next)
      return at_place(context, 0, "the next will be late");
    return at_place(context, context.current, "nothing is late yet");
  }
  void fields(settings& s) override {
    s.field("lookahead", lookahead_, duration{0});
    s.field("horizon", horizon_, lookahead_);
    s.field("epoch_s", epoch_s_, {1e-3, 3600});
  }
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "oracle"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<oracle>(*this);
  }

private:
  /// @returns when the first late result is created, at most the horizon.
  time_point good_until(const local_context& context,
                        const provider_view& provider) const {
    const auto end = context.now + horizon_;
    return context.future
        ->first_late(provider.id, context.kind, context.now, end)
        .value_or(end);
  }

  /// @returns who stays good longest, of equals by gain, then by place; null if
  /// nobody stays good for long enough.
  const provider_view* best_elsewhere(const local_context& context) const {
    const provider_view* best = nullptr;
    std::tuple<time_point, double> most{};
    for (const auto& provider : context.providers) {
      const auto until = good_until(context, provider);
      if (provider.id == context.current || until < context.now + lookahead_)
        continue;
      auto sure = provider;
      sure.link.late = 0;
      const std::tuple worth{until,
                             gain(sure, context.on_board, context.needs)};
      if (!best || worth > most) {
        best = &provider;
        most = worth;
      }
    }
    return best;
  }

  duration lookahead_ = std::chrono::seconds{1};
  duration horizon_ = std::chrono::seconds{10};
  double epoch_s_ = 0.05;
};

} // namespace

lodm_entry lodm_oracle() {
  return {{"oracle",
           "Knows what will be late; to compare with.",
           "max t_late, if t_late >= now + lookahead, then max g; home before "
           "t_late",
           "the future of all links",
           "ours, to compare with",
           {{"lookahead", "time", "nothing must be late for so long"},
            {"horizon", "time", "so far it tells providers apart"},
            {"epoch_s", "s", "between two decisions"}}},
          behind_lodm_filter<oracle>};
}

} // namespace sofof
