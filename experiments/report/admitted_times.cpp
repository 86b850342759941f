// Times of a split are sums of its services' times.
#include "experiments/report/admitted_times.hpp"

#include "offloading/service.hpp"
#include "scenario/vehicle_schedule.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string>

namespace sofof::experiments::report {

namespace {

/// @returns a service's options as they are in one vehicle of a fleet.
offloading::service_options
options_in(const scenario::fleet_options& fleet,
           const std::optional<scenario::vehicle_schedule>& shared,
           const scenario::scenario_definition& s, const std::string& name) {
  const auto* type = scenario::find_service(s, name);
  assert(type);
  auto options = type->options;
  if (shared) {
    const auto found = std::ranges::find(shared->functions, name,
                                         &scenario::function_response::service);
    assert(found != shared->functions.end());
    options.shared_response = found->at_most.value_or(duration::max());
  }
  return offloading::on(fleet.compute, options);
}

} // namespace

admitted_times::admitted_times(const scenario::scenario_definition& s) {
  const auto chain = scenario::chain_of(s);
  for (std::size_t f = 0; f < s.fleets.size(); ++f) {
    const auto& of = s.fleets[f];
    const auto shared = scenario::schedule_at_home(s, f);
    auto& to =
        fleets_.emplace_back(fleet{static_cast<std::uint64_t>(of.first_station),
                                   static_cast<std::uint64_t>(of.count),
                                   {}});
    for (const auto& name : chain) {
      const auto options = options_in(of, shared, s, name);
      to.services.push_back({offloading::own_response(options),
                             offloading::worst_response(options)});
    }
  }
}

std::optional<duration>
admitted_times::of(std::uint64_t station, const std::vector<bool>& away) const {
  const auto found = std::ranges::find_if(fleets_, [=](const fleet& x) {
    return x.first <= station && station - x.first < x.count;
  });
  if (found == fleets_.end())
    return std::nullopt;
  assert(away.size() == found->services.size());
  duration sum{0};
  for (std::size_t k = 0; k < away.size(); ++k) {
    const auto& one = found->services[k];
    const auto takes = away[k] ? one.away : one.own;
    if (takes == duration::max())
      return std::nullopt;
    sum += takes;
  }
  return sum;
}

} // namespace sofof::experiments::report
