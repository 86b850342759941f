// What others tell of their drives, as parts of the scene.
#include "planners/scene/told_scene.hpp"

#include "planners/scene/claimed_crossings.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

namespace sofof::planners {
namespace {

constexpr auto elsewhere = std::numeric_limits<double>::infinity();

/// A body is where it says to be; a lead drives as it says.
constexpr double as_told_m = 4, as_told_along_m = 4;
/// Who stands may say that it sets off; whether it does is seen when it has.
constexpr double lead_moves_mps = 1;
/// Who is slower than it says by more brakes for something.
constexpr double lead_slower_mps = 1;
/// Who may be just about to give its claim up is seen by less than that off.
constexpr double seen_share = 1.1;
/// Drives are looked for on the own way so far from the car.
constexpr double own_way_m = 200;
/// A lead is on the own way if it is not farther from it than a car by this.
constexpr double lead_beside_m = 1;
constexpr double moves_m = 0.2;
constexpr duration told_every = std::chrono::milliseconds{200};

point front_of(const oriented_box& body) {
  const point ahead{std::cos(body.heading_rad), std::sin(body.heading_rad)};
  return body.centre + 0.5 * body.length_m * ahead;
}

point rear_of(const oriented_box& body) {
  const point ahead{std::cos(body.heading_rad), std::sin(body.heading_rad)};
  return body.centre + -0.5 * body.length_m * ahead;
}

} // namespace

void find_those_who_tell(time_point now, std::span<const told_drive> told,
                         bool has_agreed, std::span<other_body> others) {
  for (const auto& [who, drive, is_claimed, front] : told) {
    if (drive.empty())
      continue;
    const auto body = drive.at(now);
    assert(drive.step > duration{});
    const auto off_m = [&, who = who, front = front](const other_body& o) {
      if (o.x.station && *o.x.station != who)
        return elsewhere;
      return o.x.station
                     || is_along(std::cos(o.x.heading_rad - body.heading_rad))
                 ? distance_m(front_of(o.x.body()), front)
                 : elsewhere;
    };
    const auto nearest = std::ranges::min_element(others, {}, off_m);
    if (nearest == others.end() || off_m(*nearest) > as_told_m)
      continue;
    assert(!nearest->x.station || *nearest->x.station == who);
    nearest->x.station = who;
    const point ahead{std::cos(body.heading_rad), std::sin(body.heading_rad)};
    nearest->has_claimed =
        has_agreed && is_claimed
        && dot(body.centre - nearest->x.centre(), ahead)
               < seen_share * most_behind_m(nearest->x.speed_mps());
    nearest->takes_part = nearest->has_claimed || (has_agreed && !is_claimed);
  }
}

void add_claimed(time_point now, const world::route& way, double front_m,
                 double half_m, std::span<const way_stretch> keep_free,
                 std::span<const told_drive> told,
                 std::vector<crossing_user>& out) {
  assert(half_m > 0);
  if (told.empty())
    return;
  const auto is_on_way = [&](const oriented_box& body) {
    const auto on = way.path().project(body.centre, front_m, own_way_m);
    const auto turned_rad =
        body.heading_rad - way.path().at(on.s_m).heading_rad;
    return std::abs(on.d_m) < half_m && is_along(std::cos(turned_rad));
  };
  assert(std::isfinite(front_m));
  std::vector<told_drive> across;
  for (const auto& x : told)
    if (x.is_claimed && !x.drive.empty() && !is_on_way(x.drive.at(now)))
      across.push_back(x);
  std::vector<crossing_user> closed;
  list_claimed(way, 2 * half_m, now, keep_free, across, closed);
  std::ranges::copy_if(closed, std::back_inserter(out),
                       [&](const auto& x) { return x.from_m >= front_m; });
  std::ranges::sort(out, {}, [](const crossing_user& x) {
    return std::tuple{x.from_m, x.to_m, x.body};
  });
}

void list_lead(time_point now, const world::route& way,
               const std::optional<lead_vehicle>& lead, double half_m,
               std::span<const told_drive> told, std::vector<way_moment>& out) {
  assert(half_m > 0);
  out.clear();
  if (!lead || !lead->station)
    return;
  const auto it = std::ranges::find(told, *lead->station, &told_drive::who);
  if (it == told.end() || it->drive.empty() || it->drive.to() <= now
      || lead->speed_mps < lead_moves_mps)
    return;
  const auto& line = way.path();
  const auto body = it->drive.at(now);
  auto guess_m = lead->rear_s_m;
  const auto rear = line.project(rear_of(body), guess_m);
  const auto off_m = guess_m - rear.s_m;
  if (std::abs(off_m) > as_told_along_m)
    return;
  // Its speed is seen along the own way, on which it may just be turning.
  const auto turned_rad = body.heading_rad - line.at(rear.s_m).heading_rad;
  const auto says_mps =
      std::cos(turned_rad)
      * distance_m(body.centre, it->drive.at(now + told_every).centre)
      / to_seconds(told_every);
  if (says_mps > lead->speed_mps + lead_slower_mps)
    return;
  assert(std::isfinite(off_m));
  const auto is_beside = [&](const world::path_offset& on) {
    return std::abs(on.d_m) > half_m + lead_beside_m;
  };
  auto turned_off = false;
  for (auto t = now; t <= it->drive.to(); t += told_every) {
    const auto on = line.project(rear_of(it->drive.at(t)), guess_m);
    guess_m = on.s_m;
    if (is_beside(on)) {
      if (!out.empty())
        return;
      turned_off = true; // unless it only turns in
      continue;
    }
    if (turned_off)
      return;
    if (out.empty() || on.s_m + off_m > out.back().s_m + moves_m)
      out.push_back({on.s_m + off_m, to_seconds(t - now)});
    else
      out.back().t_s = to_seconds(t - now); // it is there still
  }
  if (turned_off)
    out.push_back({lead->rear_s_m, 0});
}

} // namespace sofof::planners
