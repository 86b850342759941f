// Whether heating or cooling that another computer asks for may be done.
#include "planners/judges/climate_judge.hpp"

#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

constexpr double rounding_w = 1;

double limit_w(const world::cabin_params& params) {
  constexpr double share = 0.2;
  assert(params.max_heating_w >= 0 && params.max_cooling_w >= 0);
  return share * (params.max_heating_w + params.max_cooling_w) + rounding_w;
}

} // namespace

double climate_margin_w(double power_w, const judged_climate& x,
                        const world::cabin_params& params) {
  const auto own_w = world::climate_power_w(x.cabin, x.outside_c, x.set_point_c,
                                            x.horizon_s, params);
  return limit_w(params) - std::abs(power_w - own_w);
}

std::optional<objection> judge_climate(double power_w, const judged_climate& x,
                                       const world::cabin_params& params) {
  const auto most_w = power_w < 0 ? params.max_cooling_w : params.max_heating_w;
  if (!(std::abs(power_w) <= most_w + rounding_w))
    return objection{"range", power_w, most_w};
  const auto left_w = climate_margin_w(power_w, x, params);
  if (left_w < 0)
    return objection{"comfort", limit_w(params) - left_w, limit_w(params)};
  return std::nullopt;
}

} // namespace sofof::planners
