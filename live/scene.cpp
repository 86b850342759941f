// As a report says it.
#include "live/scene.hpp"

#include "experiments/report/scenery_json.hpp"
#include "world/vehicle/vehicle.hpp"

#include <nlohmann/json.hpp>

namespace sofof::live {

std::string scene_text(const scenario::live_subject& of, std::string_view run) {
  const world::vehicle_params car;
  auto all = experiments::report::scenery_json(of.what);
  all["run"] = run;
  all["name"] = of.run.scenario;
  all["version"] = of.run.version;
  all["role"] = of.role;
  all["provider"] = of.run.provider;
  all["services"] = of.run.services;
  all["chain"] = of.run.chain;
  all["car"] = {
      {"front", car.front_m}, {"rear", car.rear_m}, {"width", car.width_m}};
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace sofof::live
