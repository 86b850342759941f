// What results of a provider will be like where a vehicle is going.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// What to expect of results while a vehicle is at a place.
struct expected_quality {
  /// P(one of those that come in about a second is late or lost), in [0, 1].
  double late = 0;
  double latency_s = 0; ///< Mean, ≥ 0; 0: nothing is known.
};

/// The same, at a time to come.
struct forecast_point {
  double in_s = 0; ///< From now on, ≥ 0.
  double late = 0;
  double latency_s = 0;
};

/// What results of one provider will be like along the way.
struct provider_forecast {
  provider_id provider = 0;
  std::vector<forecast_point> along; ///< In order of time, the first of now.
};

/// What a vehicle has seen of a provider's results.
struct seen_quality {
  provider_id provider = 0;
  std::string_view service; ///< Its name.
  point at;                 ///< Where the vehicle was, m, east-north.
  double latency_s = 0;     ///< ≥ 0; infinite when nothing came.
  bool late = false;        ///< Later than the limit, or not at all.
  /// An offer, which a result would have been like: there is one where twenty
  /// results would have come, and one that is lost is not missed.
  bool is_offer = false;
};

/// Tells what results will be like at places. From one thread.
class quality_forecast {
public:
  virtual ~quality_forecast() = default;

  virtual expected_quality look(provider_id provider, std::string_view service,
                                point at) const = 0;

  /// What its vehicle has seen; who goes by something else ignores it.
  virtual void learn(const seen_quality&) {}
};

/// So far forecasts reach, s.
inline constexpr double forecast_span_s = 10;
/// A vehicle is taken to be as fast as this at least, m/s: who stands may
/// start.
inline constexpr double least_forecast_mps = 3;

/// @param path       Planned, from the vehicle on, m.
/// @param speed_mps  Of the vehicle, ≥ 0; it is taken to keep it.
/// @returns what to expect here, and at each point of the path that the vehicle
/// comes to within `forecast_span_s`; nothing without a path.
std::vector<forecast_point> forecast_along(const quality_forecast& source,
                                           provider_id provider,
                                           std::string_view service,
                                           std::span<const point> path,
                                           double speed_mps);

/// @returns the highest probability of late results from now on up to a time,
/// s; 0 without a forecast.
inline double late_within(std::span<const forecast_point> along,
                          double until_s) {
  double most = 0;
  for (const auto& x : along)
    if (x.in_s <= until_s)
      most = std::max(most, x.late);
  return most;
}

/// @returns the forecast for a provider; empty if there is none.
inline std::span<const forecast_point>
forecast_of(std::span<const provider_forecast> all, provider_id provider) {
  const auto i = std::ranges::find(all, provider, &provider_forecast::provider);
  if (i == all.end())
    return {};
  return i->along;
}

} // namespace sofof::policies
