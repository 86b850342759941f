// How much of a source is believed.
#include "maps/road_limits.hpp"

#include <fmt/format.h>

namespace sofof::maps {

namespace {

constexpr auto longest_network_m = 20e6;
constexpr std::size_t most_points_of_all = 20'000'000;

} // namespace

void road_limits::count_line(pugi::xml_node at, std::span<const point> line) {
  if (line.size() > most_points)
    file_.refuse(at, fmt::format("this lane has a line of {} points; {} are "
                                 "the most.",
                                 line.size(), most_points));
  const auto length = length_m(line);
  if (!(length <= longest_lane_m))
    file_.refuse(at, fmt::format("this lane is {:.0f} km long; {:.0f} km are "
                                 "the most.",
                                 length / 1000, longest_lane_m / 1000));
  all_m_ += length;
  all_points_ += line.size();
  if (all_m_ > longest_network_m || all_points_ > most_points_of_all)
    file_.refuse(at, fmt::format("up to here there are {:.0f} km of lanes, of "
                                 "{} points; {:.0f} km and {} points are the "
                                 "most: cut a part out of the map first.",
                                 all_m_ / 1000, all_points_,
                                 longest_network_m / 1000, most_points_of_all));
}

void road_limits::count_link(pugi::xml_node at, std::size_t from,
                             std::size_t to) {
  if (++after_[from] > most_links)
    file_.refuse(at, fmt::format("more than {} lanes follow one; leave some "
                                 "of them out.",
                                 most_links));
  if (++before_[to] > most_links)
    file_.refuse(at, fmt::format("more than {} lanes lead to one; leave some "
                                 "of them out.",
                                 most_links));
}

} // namespace sofof::maps
