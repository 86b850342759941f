// A forecast of quality by place that knows the channel's areas.
#include "scenario/place_oracle.hpp"

#include "channel/channel_draws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace sofof::scenario {

namespace {

/// By so many results a law is known; to 1 % where half of them are late.
constexpr std::uint64_t sampled_results = 2000;

/// The results of one service at one provider.
struct result_law {
  struct sample {
    duration computing;
    duration network;
  };
  std::vector<sample> samples;
  duration limit;
  double a_second = 1; ///< So many results come in one.
  double loss = 0;
};

/// @returns what to expect of results where the channel is like that.
policies::expected_quality expect(const result_law& law,
                                  const channel::place_quality& there) {
  double late = 0, sum_s = 0;
  for (const auto& x : law.samples) {
    const auto latency = x.computing + there.slowed(x.network);
    late += latency > law.limit;
    sum_s += to_seconds(latency);
  }
  const auto count = static_cast<double>(law.samples.size());
  const auto in_time = (1 - law.loss) * (1 - there.loss) * (1 - late / count);
  return {1 - std::pow(in_time, law.a_second), sum_s / count};
}

// Of a vehicle that there is not, so that no draw of the run is known.
result_law law_of(const scenario_definition& s, std::uint32_t k,
                  const offloading::service_options& options) {
  const random_stream noise{static_cast<std::uint64_t>(s.seed), "place oracle"};
  const channel::channel_draws way{s.channel_to(k), noise, 0, k};
  const auto draws = channel::result_draws(noise, 0, k);
  const auto compute = s.compute_of(k);
  const auto demand = world::demand_of(options.compute);
  result_law law{{},
                 options.limits.max_latency,
                 1 / to_seconds(options.period),
                 s.channel_to(k)->loss};
  for (std::uint64_t n = 1; n <= sampled_results; ++n)
    law.samples.push_back(
        {compute.computing_time(draws, n, demand),
         way.downlink_delay(
             n, time_point{static_cast<duration::rep>(n) * options.period})});
  return law;
}

/// What all vehicles have in common; providers by their place in the file,
/// counting from 0.
struct place_laws {
  std::vector<std::shared_ptr<const channel::channel_profile>> channels;
  std::map<std::pair<std::uint64_t, std::string>, result_law> results;
};

class place_oracle final : public policies::quality_forecast {
public:
  explicit place_oracle(std::shared_ptr<const place_laws> all)
      : all_{std::move(all)} {}

  policies::expected_quality look(provider_id provider,
                                  std::string_view service,
                                  point at) const override {
    const auto place = place_of(provider).value();
    const auto law = all_->results.find({place - 1, std::string{service}});
    if (place == 0 || law == all_->results.end())
      return {};
    const auto there =
        channel::quality_at(all_->channels[place - 1]->areas, at);
    const std::tuple key{&law->second, there.more_delay, there.delay_factor,
                         there.loss};
    if (const auto known = expected_.find(key); known != expected_.end())
      return known->second;
    return expected_.emplace(key, expect(law->second, there)).first->second;
  }

private:
  std::shared_ptr<const place_laws> all_;
  mutable std::map<std::tuple<const result_law*, duration, double, double>,
                   policies::expected_quality>
      expected_; // as somebody asks
};

} // namespace

std::function<std::shared_ptr<policies::quality_forecast>()>
foresee_places(const scenario_definition& s) {
  auto all = std::make_shared<place_laws>();
  for (std::uint32_t k = 0; k < s.providers.size(); ++k) {
    all->channels.push_back(s.channel_to(k));
    for (const auto& type : s.services)
      all->results.try_emplace({k, std::string{type->name()}},
                               law_of(s, k, type->options));
  }
  return [all = std::shared_ptr<const place_laws>{std::move(all)}] {
    return std::make_shared<place_oracle>(all);
  };
}

} // namespace sofof::scenario
