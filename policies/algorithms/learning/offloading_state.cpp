// What learners see of a service that runs at a provider, or might.
#include "policies/algorithms/learning/offloading_state.hpp"

#include "policies/filters/location.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace sofof::policies {

namespace {

constexpr double standing_mps = 0.1;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// @returns how many of the rising limits the value has reached; all if it is
/// no number.
std::size_t step_of(double value, std::span<const double> limits) {
  return static_cast<std::size_t>(std::ranges::count_if(
      limits, [value](double x) { return !(value < x); }));
}

/// @returns a latency in parts of the limit; what is unknown is beyond any.
double of_limit(const offloading_view& view,
                const std::optional<duration>& latency) {
  const auto limit_s = to_seconds(view.context.needs.max_latency);
  return latency && limit_s > 0 ? to_seconds(*latency) / limit_s : infinity;
}

/// @returns a part of `whole` from 0 to 1; 1 for what is no number.
double part(double value, double whole) {
  const auto quotient = value / whole;
  return quotient < 1 ? std::max(quotient, 0.0) : 1;
}

} // namespace

double time_left_s(const offloading_view& view) {
  const auto& provider = view.provider;
  const auto way_m = distance_in_disc_m(
      view.context.path, provider.at, provider.velocity_mps,
      view.context.speed_mps,
      std::min(view.radius_m, provider.reach_m.value_or(view.radius_m)),
      infinity);
  if (way_m <= 0)
    return 0;
  return view.context.speed_mps < standing_mps ? infinity
                                               : way_m / view.context.speed_mps;
}

std::size_t cell_of(const offloading_view& view) {
  constexpr std::array<double, 3> times_s{2, 5, 15};
  constexpr std::array<double, 4> latencies{0.5, 0.8, 1, 1.5};
  constexpr std::array<double, 3> loads{0.5, 0.7, 0.9};
  auto cell = step_of(time_left_s(view), times_s);
  cell = cell * (latencies.size() + 1)
         + step_of(of_limit(view, view.provider.link.p99), latencies);
  cell = cell * (loads.size() + 1) + step_of(view.provider.utilisation, loads);
  return cell * 2 + (view.is_remote ? 1 : 0);
}

std::array<double, offloading_features>
features_of(const offloading_view& view) {
  const auto& context = view.context;
  const auto& provider = view.provider;
  const auto& link = provider.link;
  const auto distance = context.path.empty()
                            ? infinity
                            : distance_m(context.path.front(), provider.at);
  return {part(time_left_s(view), 15),
          part(distance, 2 * view.radius_m),
          part(context.speed_mps, 25),
          part(link.late, 1),
          part(link.gap, 1),
          part(of_limit(view, link.median), 2),
          part(of_limit(view, link.p99), 2),
          part(of_limit(view, from_seconds(provider.computing_s)), 2),
          part(provider.utilisation, 2),
          part(provider.cost.energy_j, 2 * context.on_board.energy_j),
          view.is_remote ? 1.0 : 0.0,
          part(to_seconds(context.now - context.since), 10)};
}

} // namespace sofof::policies
