// Whose fault a collision is.
#include "experiments/judge/fault.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace sofof::experiments::judge {

namespace {

constexpr auto stands_mps = 0.1, stood_s = 0.5;
constexpr auto same_way_cosine = 0.5, along_cosine = 0.7071;
constexpr auto reaction_s = 0.5, decel_mps2 = 4.0;

bool has_stood(std::span<const driven_moment> drive) {
  const auto since_s = drive.back().t_s - stood_s;
  if (since_s < drive.front().t_s)
    return false;
  return std::ranges::all_of(drive, [since_s](const auto& m) {
    return m.t_s < since_s || m.car.speed_mps < stands_mps;
  });
}

point direction(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

bool ran_into_it(const world::vehicle_state& car,
                 const world::road_body& other) {
  const auto ahead = direction(car.heading_rad);
  const auto cosine = dot(ahead, direction(other.box.heading_rad));
  return cosine > same_way_cosine && other.speed_mps * cosine > car.speed_mps
         && dot(ahead, other.box.centre - car.at) < 0;
}

/// @returns how far a body is from the strip that a car takes of its way; not
/// above 0 where it reaches into it.
double beside_m(const world::route& way, double about_m,
                const oriented_box& box) {
  const auto place = way.path().project(box.centre, about_m, 60);
  const auto turn_rad = box.heading_rad - way.path().at(place.s_m).heading_rad;
  const auto half_m = (box.length_m * std::abs(std::sin(turn_rad))
                       + box.width_m * std::abs(std::cos(turn_rad)))
                      / 2;
  return std::abs(place.d_m) - half_m - world::vehicle_params{}.width_m / 2;
}

/// @returns whether it came into the way too near before the car.
bool cut_in(std::span<const driven_moment> drive, const world::route& way,
            const world::scripted_body& other) {
  const auto about_m = way.path().project(drive.back().car.at).s_m;
  std::optional<std::size_t> came;
  for (auto i = drive.size(); i-- > 0;) {
    const auto body = other.at(drive[i].t_s);
    if (!body)
      return false;
    if (beside_m(way, about_m, body->box) > 0) {
      came = i;
      break;
    }
  }
  if (!came)
    return false;
  const auto& car = drive[*came].car;
  const auto body = *other.at(drive[*came].t_s);
  const auto ahead = direction(car.heading_rad);
  const auto cosine = dot(ahead, direction(body.box.heading_rad));
  if (cosine < along_cosine)
    return false;
  const auto gap_m = dot(ahead, body.box.centre - car.at)
                     - body.box.length_m / 2 - world::vehicle_params{}.front_m;
  const auto its_mps = std::max(0.0, body.speed_mps * cosine);
  const auto faster_mps = std::max(0.0, car.speed_mps - its_mps);
  const auto needed_m =
      faster_mps * reaction_s + faster_mps * faster_mps / (2 * decel_mps2);
  return gap_m < needed_m;
}

} // namespace

fault whose_fault(std::span<const driven_moment> drive, const world::route& way,
                  const world::scripted_body& other) {
  assert(!drive.empty());
  const auto body = other.at(drive.back().t_s);
  if (has_stood(drive))
    return {false, "while it stood"};
  if (body && ran_into_it(drive.back().car, *body))
    return {false, "from behind"};
  if (body && cut_in(drive, way, other))
    return {false, "that cut in too near"};
  return {};
}

} // namespace sofof::experiments::judge
