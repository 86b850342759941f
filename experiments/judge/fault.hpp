// Whose fault a collision is.
#pragma once

#include "experiments/judge/ks_model.hpp"
#include "world/roads/route.hpp"
#include "world/traffic/scripted_body.hpp"

#include <span>
#include <string>

namespace sofof::experiments::judge {

struct fault {
  bool own = true;
  std::string why; ///< "from behind"; empty for one's own.
};

/// Obstacles of a file give way to nobody and never brake for a car that is
/// not in the file. So it is not the car's own fault when
/// * it has stood for half a second or longer;
/// * the other one, which drives the same way to within 60° and is faster, has
///   its middle behind the car's rear axle: it ran into it from behind;
/// * the other one, which drives the same way to within 45°, has come into the
///   car's lane from the side when it was too near for the car to keep off it:
///   nearer than the way that a car needs to brake to its speed with 4 m/s²,
///   half a second after it came.
/// All other collisions are the car's own fault.
/// @param drive  Up to the touch; at least one moment.
/// @param way    Of the car.
/// @param other  What it touches then.
fault whose_fault(std::span<const driven_moment> drive, const world::route& way,
                  const world::scripted_body& other);

} // namespace sofof::experiments::judge
