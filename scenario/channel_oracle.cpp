// What the channel holds in store, for a policy that is to know it.
#include "scenario/channel_oracle.hpp"

#include "base/random_phase.hpp"
#include "channel/link_direction.hpp"
#include "channel/with_outage.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::scenario {

namespace {

/// The results of one service at one provider, as they would come.
class results_to_come {
public:
  results_to_come(const channel::channel_draws& way, const random_stream& draws,
                  const channel::provider_compute& compute,
                  const offloading::service_options& options, duration phase)
      : draws_{draws}, compute_{&compute}, way_{way, channel::direction::down,
                                                nullptr},
        options_{&options}, phase_{phase} {}

  policies::foreseen_results look(time_point from, time_point until) {
    const auto since = from.time_since_epoch() - phase_;
    auto cycle = static_cast<std::uint64_t>(
        std::max<duration::rep>(0, since / options_->period));
    if (created(cycle) < from)
      ++cycle;
    foresee(until);
    policies::foreseen_results seen;
    auto count = 0.0, sum_s = 0.0;
    for (; created(cycle) < until && !seen.late; ++cycle)
      if (const auto latency_s = latencies_s_.at(cycle)) {
        sum_s += *latency_s;
        ++count;
      } else {
        seen.late = created(cycle);
      }
    seen.latency_s = count > 0 ? sum_s / count : 0;
    return seen;
  }

private:
  time_point created(std::uint64_t cycle) const {
    return time_point{phase_
                      + static_cast<duration::rep>(cycle) * options_->period};
  }

  // In order, once each: so a link has them.
  void foresee(time_point until) {
    for (auto cycle = latencies_s_.size(); created(cycle) < until; ++cycle) {
      const auto number = cycle + 1; // as services count
      const auto begun = created(cycle);
      const auto takes = compute_->computing_time(
          draws_, number, world::demand_of(options_->compute));
      sent_ = std::max(sent_, begun + takes);
      const auto comes =
          way_.arrival(sent_, channel::message_class::result, number);
      auto& latency_s = latencies_s_.emplace_back();
      if (comes && *comes - begun <= options_->limits.max_latency)
        latency_s = to_seconds(*comes - begun);
    }
  }

  random_stream draws_;
  const channel::provider_compute* compute_;
  channel::link_direction way_;
  const offloading::service_options* options_;
  duration phase_;
  time_point sent_;
  std::vector<std::optional<double>> latencies_s_; // by cycle; none: late
};

/// What all vehicles have in common.
struct air {
  struct provider {
    std::uint32_t place;
    std::shared_ptr<const channel::channel_profile> channel;
    channel::provider_compute compute;
    std::string radio;
  };
  random_stream noise;
  std::vector<actors::service_type_ptr> services;
  std::map<provider_id, provider> providers;
};

class drawn_channel_oracle final : public policies::channel_oracle {
public:
  drawn_channel_oracle(std::shared_ptr<const air> all, station_id station)
      : all_{std::move(all)}, station_{station} {}

  policies::foreseen_results look(provider_id provider,
                                  std::string_view service, time_point from,
                                  time_point until) const override {
    const auto there = all_->providers.find(provider);
    const auto wanted = std::ranges::find(
        all_->services, service, [](const auto& k) { return k->name(); });
    if (there == all_->providers.end() || wanted == all_->services.end())
      return {from, 0};
    return of(provider, there->second, **wanted).look(from, until);
  }

private:
  results_to_come& of(provider_id id, const air::provider& provider,
                      const actors::service_type& type) const {
    const std::pair key{id, std::string{type.name()}};
    if (const auto known = results_.find(key); known != results_.end())
      return known->second;
    const auto own = all_->noise.part(type.name()).part(station_.value());
    return results_
        .try_emplace(
            key,
            channel::channel_draws{provider.channel, all_->noise, station_,
                                   provider.place, provider.radio},
            channel::result_draws(all_->noise, station_, provider.place,
                                  provider.radio),
            provider.compute, type.options,
            random_phase(own.part("remote phase"), type.options.period))
        .first->second;
  }

  std::shared_ptr<const air> all_;
  station_id station_;
  mutable std::map<std::pair<provider_id, std::string>, results_to_come>
      results_; // as somebody asks
};

} // namespace

std::function<std::shared_ptr<const policies::channel_oracle>(station_id)>
foresee(const scenario_definition& s) {
  auto all = std::make_shared<air>(
      air{random_stream{static_cast<std::uint64_t>(s.seed), "network"},
          s.services,
          {}});
  for (std::uint32_t k = 0; k < s.providers.size(); ++k) {
    const auto& x = s.providers[k];
    const auto add =
        [&](std::uint64_t start,
            std::shared_ptr<const channel::channel_profile> channel) {
          all->providers[provider_at(k + 1, start)] = {
              k, std::move(channel), s.compute_of(k), x.radio};
        };
    const auto channel = s.channel_to(k);
    add(0, x.fails_at
               ? channel::with_outage(*channel, *x.fails_at, duration::max())
               : channel);
    if (x.returns_at)
      add(1, channel::with_outage(*channel, {}, *x.returns_at));
  }
  return [all = std::shared_ptr<const air>{all}](station_id station) {
    return std::make_shared<drawn_channel_oracle>(all, station);
  };
}

} // namespace sofof::scenario
