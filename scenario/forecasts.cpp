// From the options of forecasts by place to the forecast of each vehicle.
#include "scenario/forecasts.hpp"

#include "policies/algorithms/forecast/learned_forecast.hpp"
#include "scenario/place_oracle.hpp"
#include "scenario/quality_file.hpp"

namespace sofof::scenario {

namespace {

const forecast_options& options_of(const scenario_definition& s) {
  return s.policies.forecast;
}

} // namespace

place_forecasts::place_forecasts(const scenario_definition& s) : s_{s} {
  const auto& options = options_of(s);
  if (options.source == "oracle")
    oracle_ = foresee_places(s);
  if (options.shared || options.source == "file")
    common_ = make_map();
}

std::shared_ptr<policies::quality_map> place_forecasts::make_map() const {
  const auto& options = options_of(s_);
  auto map = std::make_shared<policies::quality_map>(
      policies::quality_map_options{.cell_m = options.cell_m});
  for (const auto& x : options.places)
    map->add(x.service, provider_at(x.provider + 1, 0), map->cell_of(x.at),
             x.known);
  return map;
}

std::shared_ptr<policies::quality_forecast> place_forecasts::for_vehicle() {
  const auto& options = options_of(s_);
  if (oracle_)
    return oracle_();
  if (common_)
    return std::make_shared<policies::learned_forecast>(common_,
                                                        options.learns());
  if (!options.learns())
    return nullptr;
  own_.push_back(make_map());
  return std::make_shared<policies::learned_forecast>(own_.back());
}

std::string place_forecasts::learned_csv() const {
  if (!options_of(s_).learns())
    return {};
  if (common_)
    return quality_csv(*common_, s_);
  policies::quality_map all{{.cell_m = options_of(s_).cell_m}};
  for (const auto& map : own_)
    all.add(*map);
  return quality_csv(all, s_);
}

} // namespace sofof::scenario
