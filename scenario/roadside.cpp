// Sensors at the roadside, as the actors of a scenario have them.
#include "scenario/roadside.hpp"

#include <algorithm>

namespace sofof::scenario {

std::vector<actors::roadside_sensor>
sensors_beside(const random_stream& noise,
               const std::vector<provider_cell>& cells,
               const process_share& here) {
  if (here.serves_others)
    return {};
  std::vector<actors::roadside_sensor> beside;
  for (const auto& cell : cells) {
    const auto& own = cell.options->sensors;
    const auto drawn = noise.part(cell.place);
    for (std::size_t k = 0; k < own.size(); ++k)
      beside.push_back({cell.provider, own[k].make(drawn.part(k))});
  }
  return beside;
}

world::sensor_params noisier(world::sensor_params one,
                             const world::sensor_params& other) {
  const auto worsen = [](double& x, double y) { x = std::max(x, y); };
  worsen(one.position_noise_m, other.position_noise_m);
  worsen(one.speed_noise_mps, other.speed_noise_mps);
  worsen(one.heading_noise_rad, other.heading_noise_rad);
  return one;
}

} // namespace sofof::scenario
