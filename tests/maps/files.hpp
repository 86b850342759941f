// The small maps of these tests, and what became of them.
#pragma once

#include "base/options/toml_file.hpp"
#include "world/roads/streets.hpp"

#include <doctest/doctest.h>

#include "maps/import.hpp"
#include <algorithm>
#include <string>
#include <string_view>

namespace sofof::maps_tests {

inline std::string text_of(std::string_view file) {
  const auto text = read_text(std::string{SOFOF_SOURCE_DIR "/tests/maps/data/"}
                              + std::string{file});
  REQUIRE(text);
  return *text;
}

inline maps::imported_map imported(std::string_view text,
                                   std::string_view file) {
  return maps::import({text, std::string{file}}, "test");
}

inline maps::imported_map imported(std::string_view file) {
  return imported(text_of(file), file);
}

/// @returns the lane of that name; null if there is none.
inline const world::lane* find_lane(const maps::imported_map& map,
                                    std::string_view name) {
  const auto found = std::ranges::find(map.lanes, name, &world::lane::name);
  return found == map.lanes.end() ? nullptr : &*found;
}

inline const world::lane& lane_of(const maps::imported_map& map,
                                  std::string_view name) {
  const auto* found = find_lane(map, name);
  REQUIRE(found);
  return *found;
}

/// @returns its lanes and routes as they are driven.
inline world::streets streets_of(const maps::imported_map& map) {
  world::streets made{world::road_map{map.name, {}, map.lanes}, {}};
  for (const auto& r : map.routes)
    made.routes.push_back(made.map.make_route(r.name, r.lanes, r.closed));
  return made;
}

/// Lanes meet to within 5 cm and can be driven.
inline void check_drivable(const maps::imported_map& map) {
  for (const auto& l : map.lanes)
    for (const auto& next : l.next)
      CHECK(distance_m(l.centre.back(), lane_of(map, next).centre.front())
            <= 0.05);
  const auto made = streets_of(map);
  CHECK(!made.routes.empty());
  for (const auto& r : made.routes)
    for (auto s_m = 0.0; s_m < r->length_m(); s_m += 0.2)
      REQUIRE(std::abs(r->path().curvature_1pm(s_m)) < 0.216); // a car's, 1/m
}

} // namespace sofof::maps_tests
