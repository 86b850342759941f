// What a provider knows of a crossing, and how it conducts it.
#include "actors/services/crossing/crossing_office.hpp"

#include "actors/services/planning/drive_words.hpp"
#include "base/protocol.hpp"
#include "world/roads/route_finder.hpp"

#include <cmath>
#include <utility>

namespace sofof::actors {

namespace {

/// Who is farther from what it has claimed does not keep to it, m.
constexpr double keeps_claim_m = 3;

/// More stations than these are not listened to.
constexpr std::size_t most_heard = 1000;

} // namespace

crossing_office::crossing_office(crossing_world_ptr world,
                                 std::function<time_point()> clock)
    : world_{std::move(world)}, clock_{std::move(clock)},
      conductor_{planners::crossing_ways{
                     world_->lanes,
                     {world_->options.centre, world_->options.radius_m},
                     world_->car},
                 {}} {}

void crossing_office::on_cam(const messages::cam& c, sender_id) {
  if (protocol::is_of_future(c.at, clock_()))
    return;
  const std::lock_guard lock{mutex_};
  if (heard_.size() >= most_heard)
    forget_silent(clock_());
  if (heard_.size() >= most_heard && !heard_.contains(c.station))
    return;
  auto& x = heard_[c.station];
  if (x.newest.at <= c.at)
    x.newest = c;
}

void crossing_office::on_word(const messages::decoded_mcm& word, sender_id) {
  if (protocol::is_of_future(word.at, clock_()))
    return;
  const std::lock_guard lock{mutex_};
  const auto x = heard_.find(word.from);
  if (x != heard_.end() // it has sent a CAM
      && (!x->second.word || x->second.word->at < word.at))
    x->second.word = word;
}

world::trajectory crossing_office::advise(time_point now, station_id who) {
  const std::lock_guard lock{mutex_};
  asks_.insert(who);
  if (!planned_ || now - *planned_ >= period)
    plan(now);
  const auto x = advice_.find(who);
  if (x == advice_.end() || x->second.end() <= now)
    return {};
  return x->second;
}

void crossing_office::leave(station_id who) {
  const std::lock_guard lock{mutex_};
  asks_.erase(who);
  advice_.erase(who);
}

planners::route_profile_ptr
crossing_office::profile(const world::route_ptr& way) {
  auto& known = profiles_[way.get()];
  if (!known)
    known = std::make_shared<const planners::route_profile>(
        way, planners::comfort_limits{});
  return known;
}

/// @returns whether it is known where on which way it is.
bool crossing_office::place(heard& x) const {
  if (!x.word || x.word->way.empty())
    return false;
  if (x.way) {
    if (const auto on =
            world::still_on(x.way->line.way(), x.s_m, x.word->way)) {
      const auto& path = x.way->line.way().path();
      x.s_m = path.project(x.newest.position, on->from_m).s_m;
      return true;
    }
  }
  return false;
}

/// @returns how a vehicle says that it drives; empty: it does not.
world::trajectory crossing_office::plan_of(const heard& x) const {
  world::trajectory plan;
  if (!x.word || !x.word->plan)
    return plan;
  const messages::maneuver_frame frame{world_->where->frame, x.word->reference,
                                       x.word->at};
  if (messages::to_trajectory(*x.word->plan, frame, x.way->line.way(), x.s_m,
                              nullptr, plan)
      != messages::maneuver_fault::none)
    plan.points.clear();
  return plan;
}

void crossing_office::forget_silent(time_point now) {
  std::erase_if(heard_, [now](const auto& x) {
    return now - x.second.newest.at > protocol::cam_timeout;
  });
}

void crossing_office::plan(time_point now) {
  planned_ = now;
  forget_silent(now);
  std::vector<planners::approaching_car> cars;
  for (auto& [who, x] : heard_) {
    if (!place(x)) {
      x.way = nullptr;
      if (!x.word || x.word->way.empty())
        continue;
      const auto found =
          world::find_route(world_->streets->routes, x.word->way);
      if (!found)
        continue;
      x.way = profile(found->way);
      x.s_m = found->way->path()
                  .project(x.newest.position, found->ahead.from_m)
                  .s_m;
    }
    planners::approaching_car car{who,
                                  x.way,
                                  x.s_m,
                                  x.newest.speed_mps,
                                  x.newest.accel_mps2,
                                  asks_.contains(who),
                                  {},
                                  false};
    car.s_m += to_seconds(now - x.newest.at) * x.newest.speed_mps;
    // What it says of its drive is newer than its CAM, and knows how it brakes;
    // but whether it keeps to what it has claimed the CAM tells.
    const auto plan = plan_of(x);
    const auto has_claimed = is_claim(*x.word) && !plan.empty();
    if (!plan.empty() && plan.end() > now
        && (!has_claimed
            || std::abs(plan.at(now).s_m - car.s_m) < keeps_claim_m)) {
      const auto here = plan.at(now);
      car.s_m = here.s_m;
      car.speed_mps = here.speed_mps;
      car.accel_mps2 = here.accel_mps2;
    }
    const auto advised = advice_.find(who);
    if (has_claimed) {
      car.drive = plan;
      car.has_claimed = true;
    } else if (advised != advice_.end() && now < advised->second.end()) {
      car.drive = advised->second;
    }
    cars.push_back(std::move(car));
  }
  std::vector<planners::crossing_advice> out;
  conductor_.plan(now, cars, out);
  for (auto& x : out)
    advice_[x.who] = std::move(x.drive);
  std::erase_if(advice_, [&](const auto& x) {
    return x.second.empty() || x.second.end() <= now
           || !asks_.contains(x.first);
  });
}

} // namespace sofof::actors
