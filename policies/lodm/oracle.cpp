// LODM "oracle": knows what will be late.
#include "policies/api/weights.hpp"
#include "policies/entry.hpp"

#include <algorithm>

namespace sofof::policies {

namespace {

/// Of those where nothing will be late for a while, goes where a cycle costs
/// least, and leaves just before the first late result; to compare with, as
/// nobody knows the future. It knows what links do, not what others ask for.
class oracle final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    if (!context.future)
      return at_place(context.current, context.current, "no foresight here");
    const auto* here = where_it_runs(context);
    const auto stay = here ? prospect_of(context, *here) : prospect{};
    const auto next = context.now + from_seconds(epoch_s_);
    const auto soon = std::max(next, context.now + lookahead_);
    const provider_view* best = nullptr;
    auto most = here && stay.until >= soon ? stay.gain + margin_ : 0;
    most = std::max(most, 0.0);
    for (const auto& provider : context.providers)
      if (provider.id != context.current)
        if (const auto there = prospect_of(context, provider);
            there.until >= soon && there.gain > most) {
          best = &provider;
          most = there.gain;
        }
    if (best)
      return at_place(context.current, best->id, "the best to come");
    if (!here)
      return as_it_is("nothing good is to come");
    if (stay.until <= next)
      return at_place(context.current, std::nullopt, "the next will be late");
    if (!(stay.gain >= 0)) // nor what is no number
      return at_place(context.current, std::nullopt, "the gain has gone");
    return at_place(context.current, context.current, "nothing is late yet");
  }
  void visit_options(option_visitor& s) override {
    s.field("lookahead", lookahead_, duration{0});
    s.field("horizon", horizon_, lookahead_);
    s.field("margin", margin_, {0, 1e3});
    list_weights(s, weights_);
    s.field("epoch_s", epoch_s_, {1e-3, 3600});
  }
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "oracle"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<oracle>(*this);
  }

private:
  struct prospect {
    time_point until; ///< Nothing is late before; at most the horizon.
    double gain = 0;
  };

  prospect prospect_of(const local_context& context,
                       const provider_view& provider) const {
    const auto end = context.now + horizon_;
    const auto coming =
        context.future->look(provider.id, context.service, context.now, end);
    auto sure = provider;
    sure.link.late = 0;
    sure.link.median = from_seconds(coming.latency_s);
    return {coming.late.value_or(end),
            gain(sure, context.on_board, context.needs, weights_)};
  }

  duration lookahead_ = std::chrono::seconds{1};
  duration horizon_ = std::chrono::seconds{10};
  double margin_ = 0.01;
  cost_weights weights_;
  double epoch_s_ = 0.05;
};

} // namespace

lodm_entry lodm_oracle() {
  return {
      {"oracle", "Knows what will be late; to compare with.",
       "max g over t_late >= now + lookahead, by the mean latency until "
       "t_late; home before t_late",
       "the future of all links, energy of a cycle here and there",
       "ours, to compare with",
       weights_and({{"lookahead", "time", "nothing must be late for so long"},
                    {"horizon", "time", "so far it looks"},
                    {"margin", "1", "gain that is worth a change"},
                    {"epoch_s", "s", "between two decisions"}})},
      filtered_by_provider<oracle>};
}

} // namespace sofof::policies
