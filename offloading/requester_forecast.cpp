// What a requester learns of places, and what it tells policies of those ahead.
#include "offloading/requester.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sofof::offloading {

// Of those that come into question, if the policy wants to know.
std::vector<policies::provider_forecast>
requester::forecasts(const service_state& service,
                     std::span<const policies::provider_view> providers,
                     std::span<const point> path) const {
  std::vector<policies::provider_forecast> all;
  if (!setup_.forecast || !setup_.policy->needs_forecast())
    return all;
  assert(std::isfinite(ego_.own.speed_mps));
  for (const auto& x : providers)
    all.push_back({x.id, policies::forecast_along(*setup_.forecast, x.id,
                                                  service.service.name.view(),
                                                  path, ego_.own.speed_mps)});
  assert(all.size() == providers.size());
  return all;
}

void requester::learn_place(const service_state& service, provider_id provider,
                            duration latency, bool is_offer) {
  assert(provider != provider_id{0});
  assert(service.needs.max_latency > duration{0});
  if (setup_.forecast)
    setup_.forecast->learn({.provider = provider,
                            .service = service.service.name.view(),
                            .at = ego_.own.position,
                            .latency_s = std::max(0.0, to_seconds(latency)),
                            .late = latency > service.needs.max_latency,
                            .is_offer = is_offer});
}

// What has nothing to do with the place, as a wrong result, is not told.
void requester::learn_missed(const service_state& service,
                             provider_id provider) {
  if (setup_.forecast)
    setup_.forecast->learn(
        {.provider = provider,
         .service = service.service.name.view(),
         .at = ego_.own.position,
         .latency_s = std::numeric_limits<double>::infinity(),
         .late = true});
}

} // namespace sofof::offloading
