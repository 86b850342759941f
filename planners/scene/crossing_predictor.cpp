// Who crosses the own way, when, and who goes first.
#include "planners/scene/crossing_predictor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

/// Who would have to brake harder than this to give way does not, m/s².
constexpr auto yielding_decel_mps2 = 6.0;

/// To be expected at once; more take more memory, once.
constexpr std::size_t many = 128;

double forward_mps(const track& x) {
  return std::max(0.0, x.speed_mps());
}

bool gives_way(const track& x, const conflict_visit& when, int own_rank) {
  const auto v = forward_mps(x);
  return when.way_m > 0 && when.rank > own_rank
         && v * v <= 2 * yielding_decel_mps2 * when.way_m;
}

} // namespace

crossing_predictor::crossing_predictor(
    std::shared_ptr<const lane_network> lanes, world::route_ptr way,
    double corridor_m, double foresight_s)
    : lanes_{std::move(lanes)}, way_{std::move(way), lanes_->meetings()},
      corridor_m_{corridor_m}, foresight_s_{foresight_s} {
  assert(corridor_m_ > 0 && foresight_s_ >= 0);
  zones_.reserve(many);
  arrivals_.reserve(many);
  foreseen_.reserve(many);
}

void crossing_predictor::judge(double from_m, double to_m,
                               std::span<other_body> others,
                               std::vector<crossing_user>& found,
                               std::vector<double>& yields) {
  assert(from_m < to_m);
  find_zones(from_m, to_m);
  for (const auto& [own, middle] : zones_)
    if (lanes_->rank(own.other_side()) < own.rank)
      yields.push_back(own.from_m);
  foresee(others);
  for (const auto& [own, middle] : zones_)
    for (const auto& [who, when] : foreseen_) {
      auto& [x, is_crossing] = others[who];
      if (when.side != own.other_side()
          || (when.way_m == 0 && drives_along(x, own)))
        continue;
      found.push_back({own.from_m, own.to_m, when.enter_s, when.leave_s,
                       !gives_way(x, when, own.rank)});
      is_crossing = is_crossing || std::isfinite(when.leave_s);
    }
  assert(std::ranges::is_sorted(found, {}, &crossing_user::from_m));
  assert(std::ranges::is_sorted(yields));
}

void crossing_predictor::find_zones(double from_m, double to_m) {
  assert(way_.longest_zone_m() >= 0);
  zones_.clear();
  way_.for_zones(from_m - way_.longest_zone_m(), to_m,
                 [&](const world::zone& z) {
                   const auto middle_m = (z.from_m + z.to_m) / 2;
                   assert(z.from_m <= z.to_m && z.from_m < to_m);
                   if (z.to_m > from_m)
                     zones_.push_back({z, way_.on()->path().at(middle_m).at});
                   return true;
                 });
}

/// Finds out when the others reach conflicts, if they may reach the own ones.
void crossing_predictor::foresee(std::span<const other_body> others) {
  foreseen_.clear();
  for (std::size_t who = 0; who < others.size(); ++who) {
    const auto& x = others[who].x;
    const auto within_m =
        std::min(foresight_s_ * forward_mps(x), lane_network::farthest_m);
    assert(within_m >= 0 && x.length_m > 0);
    const auto gets_there = [&](const own_zone& z) {
      const auto reach_m = within_m + x.length_m + z.on.to_m - z.on.from_m;
      const auto apart = z.middle - x.centre();
      return dot(apart, apart) < reach_m * reach_m;
    };
    if (std::ranges::none_of(zones_, gets_there))
      continue;
    arrivals_.clear();
    lanes_->foresee(x, within_m, arrivals_);
    for (const auto& when : arrivals_) {
      assert(when.enter_s <= when.leave_s);
      foreseen_.push_back({who, when});
    }
  }
}

/// @returns whether a body at a zone drives on the own way already.
bool crossing_predictor::drives_along(const track& x,
                                      const world::zone& z) const {
  const auto& line = way_.on()->path();
  const auto on = line.project(x.centre(), (z.from_m + z.to_m) / 2,
                               (z.to_m - z.from_m) / 2 + x.length_m);
  const auto turned_rad = x.heading_rad - line.at(on.s_m).heading_rad;
  return std::abs(on.d_m) < corridor_m_ && is_along(std::cos(turned_rad));
}

} // namespace sofof::planners
