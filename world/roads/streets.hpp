// The streets of a scenario and the ways that vehicles take through them.
#pragma once

#include "world/roads/road_map.hpp"

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

namespace sofof::world {

struct streets {
  road_map map;
  std::vector<route_ptr> routes; ///< In order of definition.

  /// @returns the route of that name; null when there is none.
  route_ptr find(std::string_view name) const {
    auto i = std::ranges::find(routes, name, [](const auto& r) {
      return std::string_view{r->name()};
    });
    return i == routes.end() ? nullptr : *i;
  }
};

using streets_ptr = std::shared_ptr<const streets>;

} // namespace sofof::world
