// Which planner plans, and how.
#include "actors/services/planning/planner_options.hpp"

#include "planners/trajectory/lane_follow.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace sofof {

namespace {

constexpr std::string_view optimal_planner = "al_ilqr";
constexpr std::string_view simple_planner = "lane_follow";

} // namespace

void planner_options::visit_options(option_visitor& s) {
  s.field("name", name);
  if (name != optimal_planner && name != simple_planner)
    s.refuse("name", fmt::format("there is no planner '{}'; choose {} or {}",
                                 name, optimal_planner, simple_planner));
  style.visit_options(s);
  s.table("onboard", [this](option_visitor& t) { onboard.visit_options(t); });
  s.table("mec", [this](option_visitor& t) { mec.visit_options(t); });
}

std::unique_ptr<trajectory_planner> planner_options::make(const route_ptr& way,
                                                          known_roads& roads,
                                                          bool remote) const {
  auto profile = roads.profile(way);
  if (name == simple_planner)
    return std::make_unique<lane_follow>(std::move(profile), style);
  return std::make_unique<spatial_planner>(std::move(profile), style,
                                           remote ? mec : onboard);
}

} // namespace sofof
