// A forecast of quality by place, of what vehicles have seen there.
#include "policies/algorithms/forecast/learned_forecast.hpp"

#include <cassert>
#include <cmath>

namespace sofof::policies {

namespace {

/// Of a visit of which offers alone tell: there is one where twenty results
/// would have come.
constexpr double weight_of_offers = 0.2;

double visit_weight(bool has_results) {
  return has_results ? 1 : weight_of_offers;
}

} // namespace

learned_forecast::learned_forecast(std::shared_ptr<quality_map> map,
                                   bool learns)
    : map_{std::move(map)}, learns_{learns} {
  assert(map_);
}

expected_quality learned_forecast::look(provider_id provider,
                                        std::string_view service,
                                        point at) const {
  const auto cell = map_->cell_of(at);
  const auto place = place_of(provider);
  return {map_->late(service, place, cell),
          map_->at(service, place, cell).latency_s};
}

void learned_forecast::learn(const seen_quality& seen) {
  if (!learns_)
    return;
  const auto cell = map_->cell_of(seen.at);
  const std::string service{seen.service};
  const auto provider = place_of(seen.provider);
  const auto [i, is_first] =
      visits_.try_emplace({service, provider}, visit{.cell = cell});
  auto& now = i->second;
  if (now.cell != cell) {
    leave(service, provider, now);
    now = {.cell = cell};
  }
  now.has_results = now.has_results || !seen.is_offer;
  if (std::isfinite(seen.latency_s)) {
    now.came += 1;
    now.latency_s += (seen.latency_s - now.latency_s) / now.came;
  }
  const auto more = visit_weight(!seen.is_offer) - now.noted_late;
  if (!seen.late || more <= 0)
    return;
  map_->add(service, provider, cell, {more, more, now.latency_s});
  now.noted_late += more;
}

void learned_forecast::leave(const std::string& service, provider_id provider,
                             const visit& x) {
  if (x.came == 0 || x.noted_late > 0)
    return;
  map_->add(service, provider, x.cell,
            {visit_weight(x.has_results), 0, x.latency_s});
}

} // namespace sofof::policies
