// What is known of the routes of cars, shared by all on one route.
#pragma once

#include "planners/speed/route_profile.hpp"

#include <map>

namespace sofof::actors {

/// Routes as they are driven in comfort; each is looked at once.
class comfortable_roads {
public:
  planners::route_profile_ptr of(const world::route_ptr& way);

private:
  std::map<const world::route*, planners::route_profile_ptr> known_;
};

} // namespace sofof::actors
