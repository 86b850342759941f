// What the channel holds in store, for a policy that is to know it.
#include "scenario/foresight.hpp"

#include "world/drawn_phase.hpp"
#include "world/link_direction.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof {

namespace {

/// The results of one service at one provider, as they would come.
class results_to_come {
public:
  results_to_come(const channel& draws, const service_options& options,
                  duration phase)
      : draws_{draws}, way_{draws, way::down, nullptr}, options_{&options},
        phase_{phase} {}

  std::optional<time_point> first_late(time_point from, time_point until) {
    const auto since = from.time_since_epoch() - phase_;
    auto cycle = static_cast<std::uint64_t>(
        std::max<duration::rep>(0, since / options_->period));
    if (created(cycle) < from)
      ++cycle;
    foresee(until);
    for (; created(cycle) < until; ++cycle)
      if (late_.at(cycle))
        return created(cycle);
    return std::nullopt;
  }

private:
  time_point created(std::uint64_t cycle) const {
    return time_point{phase_
                      + static_cast<duration::rep>(cycle) * options_->period};
  }

  // In order, once each: so a link has them.
  void foresee(time_point until) {
    for (auto cycle = late_.size(); created(cycle) < until; ++cycle) {
      const auto number = cycle + 1; // as services count
      const auto work =
          to_seconds(draws_.service_time(number)) * options_->demand;
      const auto begun = created(cycle);
      sent_ = std::max(sent_, begun + from_seconds(work));
      const auto comes = way_.arrival(sent_, message_class::result, number);
      late_.push_back(!comes || *comes - begun > options_->limits.max_latency);
    }
  }

  channel draws_;
  link_direction way_;
  const service_options* options_;
  duration phase_;
  time_point sent_;
  std::vector<bool> late_; // by cycle
};

/// What all vehicles have in common.
struct air {
  struct provider {
    std::shared_ptr<const channel_profile> channel;
    std::string radio;
  };
  random_stream noise;
  std::vector<service_kind_ptr> kinds;
  std::vector<provider> providers; // the first one boots as number 1
};

class channel_foresight final : public foresight {
public:
  channel_foresight(std::shared_ptr<const air> all, station_id station)
      : all_{std::move(all)}, station_{station} {}

  std::optional<time_point> first_late(boot_id provider, std::string_view kind,
                                       time_point from,
                                       time_point until) const override {
    const auto found = std::ranges::find(
        all_->kinds, kind, [](const auto& k) { return k->name(); });
    if (provider == 0 || provider > all_->providers.size()
        || found == all_->kinds.end())
      return from;
    return of(static_cast<std::uint32_t>(provider - 1), **found)
        .first_late(from, until);
  }

private:
  results_to_come& of(std::uint32_t provider, const service_kind& kind) const {
    const std::pair key{provider, std::string{kind.name()}};
    if (const auto known = results_.find(key); known != results_.end())
      return known->second;
    const auto& there = all_->providers[provider];
    const auto own = all_->noise.part(kind.name()).part(station_);
    return results_
        .try_emplace(key,
                     channel{there.channel, all_->noise, station_, provider,
                             there.radio},
                     kind.common,
                     drawn_phase(own.part("remote phase"), kind.common.period))
        .first->second;
  }

  std::shared_ptr<const air> all_;
  station_id station_;
  mutable std::map<std::pair<std::uint32_t, std::string>, results_to_come>
      results_; // as somebody asks
};

} // namespace

std::function<std::shared_ptr<const foresight>(station_id)>
foresee(const scenario& s) {
  auto all = std::make_shared<air>(
      air{random_stream{static_cast<std::uint64_t>(s.seed), "network"},
          s.services,
          {}});
  for (std::uint32_t k = 0; k < s.providers.size(); ++k)
    all->providers.push_back({s.channel_to(k), s.providers[k].radio});
  return [all = std::shared_ptr<const air>{all}](station_id station) {
    return std::make_shared<channel_foresight>(all, station);
  };
}

} // namespace sofof
