// From the options of forecasts by place to the forecast of each vehicle.
#pragma once

#include "policies/algorithms/forecast/quality_map.hpp"
#include "policies/api/quality_forecast.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sofof::scenario {

/// The forecasts of a run, and what vehicles have learned for them.
class place_forecasts {
public:
  /// @param s  Loaded; outlives this.
  explicit place_forecasts(const scenario_definition& s);

  /// @returns that of one more vehicle; null if there are none.
  std::shared_ptr<policies::quality_forecast> for_vehicle();

  /// @returns what all vehicles have learned, as quality.csv; empty if they
  /// learn nothing.
  std::string learned_csv() const;

private:
  std::shared_ptr<policies::quality_map> make_map() const;

  const scenario_definition& s_;
  std::function<std::shared_ptr<policies::quality_forecast>()> oracle_;
  std::shared_ptr<policies::quality_map> common_; ///< Of all, if they share.
  std::vector<std::shared_ptr<policies::quality_map>> own_;
};

} // namespace sofof::scenario
