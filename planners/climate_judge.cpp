// Whether heating or cooling that another computer asks for may be done.
#include "planners/climate_judge.hpp"

#include <cmath>

namespace sofof {

std::optional<objection> judge_climate(double power_w, const judged_climate& x,
                                       const cabin_params& params) {
  constexpr double share = 0.2;
  constexpr double rounding_w = 1;
  const auto most_w = power_w < 0 ? params.max_cooling_w : params.max_heating_w;
  if (!(std::abs(power_w) <= most_w + rounding_w))
    return objection{"range", power_w, most_w};
  const auto own_w =
      climate_power_w(x.cabin, x.outside_c, x.set_point_c, x.horizon_s, params);
  const auto apart_w = std::abs(power_w - own_w);
  const auto limit_w =
      share * (params.max_heating_w + params.max_cooling_w) + rounding_w;
  if (apart_w > limit_w)
    return objection{"comfort", apart_w, limit_w};
  return std::nullopt;
}

} // namespace sofof
