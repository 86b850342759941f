// What a provider perceives, once for all its services.
#include "actors/services/planning/perceived_at.hpp"

namespace sofof::actors {

std::shared_ptr<edge_perception>
perceived_at(const planning_world& world,
             const offloading::provider_context& provider) {
  constexpr station_id everybody = 0;
  if (const auto known =
          world.beside->find(chain_part::hearing, provider.id, everybody))
    return std::static_pointer_cast<edge_perception>(known);
  auto made = std::make_shared<edge_perception>(
      provider.clock, world.streets->map.buildings(),
      planners::noise_of(world.eyes), world.where);
  if (provider.id != 0)
    world.beside->add(chain_part::hearing, provider.id, everybody, made);
  return made;
}

} // namespace sofof::actors
