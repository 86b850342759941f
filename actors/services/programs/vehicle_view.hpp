// What programs of one vehicle may take their inputs from.
#pragma once

#include "actors/simulation/plan_client.hpp"
#include "messages/v2x/georeference.hpp"
#include "world/sensing/sensors.hpp"
#include "world/vehicle/vehicle.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

/// Where a vehicle was, what it saw and where it goes.
struct vehicle_look {
  messages::cam own;
  world::perception seen;
  std::vector<point> route; ///< The way ahead, m, east-north.
};

/// The newest look of one vehicle, and the newest result of each of its
/// programs. Several threads may use it.
class vehicle_view {
public:
  /// How a vehicle tells others what it sees.
  struct tells {
    messages::georeference_ptr where;
    world::vehicle_params car{};
    world::sensor_params sensor{};
    bool is_release_2 = false;
  };

  explicit vehicle_view(tells how) : how_{std::move(how)} {}

  const tells& how() const { return how_; }

  void see(vehicle_look look);
  vehicle_look newest() const; ///< Nothing yet: `own.station` is 0.

  void keep_result(std::string_view service, std::vector<std::byte> octets);
  /// @returns that of a service; empty: none yet.
  std::vector<std::byte> result_of(std::string_view service) const;

private:
  tells how_;
  mutable std::mutex lock_;
  vehicle_look newest_;
  std::map<std::string, std::vector<std::byte>, std::less<>> results_;
};

/// @returns a client that asks as `asks` does, and lets `view` see what the
/// vehicle does.
std::shared_ptr<const plan_client>
onlooking(std::shared_ptr<const plan_client> asks,
          std::shared_ptr<vehicle_view> view);

} // namespace sofof::actors
