// Others drive as they like within what RSS assumes; the vehicles that are
// looked at have the program's own planner, and offload.
#include "tests/support/safe_scenes.hpp"

#include "actors/services/planning/plan_request.hpp"
#include "experiments/torture/changed_service.hpp"
#include "experiments/torture/lottery.hpp"
#include "offloading/service.hpp"
#include "planners/safety/safe_response.hpp"
#include "scenario/load.hpp"
#include "scenario/placement.hpp"
#include "tests/scenario/whole_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sofof::test {

namespace {

using experiments::torture::changed_service;
using experiments::torture::lottery;
using namespace std::chrono_literals;

constexpr auto planning_name = "trajectory_planning";
constexpr station_id::rep first_free = 201; // stations that drive as they like
constexpr auto limit_mps = 13.8;
constexpr auto lasts_s = 12.0;
/// The home split's time, and the lag of the brake.
constexpr auto starts_safe_under_s = 0.35;

/// Accelerations, one after the other.
struct free_drive {
  struct part {
    double until_s, accel_mps2;
  };
  std::vector<part> parts;

  double at(double t_s) const {
    for (const auto& x : parts)
      if (t_s < x.until_s)
        return x.accel_mps2;
    return 0;
  }
};

free_drive drawn_drive(lottery of) {
  free_drive drive;
  for (auto t_s = of.number(0.3, 4, 2); t_s < lasts_s;
       t_s += of.number(0.4, 3, 2)) {
    drive.parts.push_back({t_s, drive.parts.empty() ? 0.0
                                : of.happens(0.45)  ? -of.number(1, 7.9, 1)
                                : of.happens(0.6)   ? of.number(0.3, 1.5, 1)
                                                    : 0.0});
  }
  drive.parts.push_back({lasts_s + 10, 0});
  return drive;
}

/// Drives along its way by such accelerations, and stops at a line.
class free_driver final : public offloading::service_function {
public:
  free_driver(world::streets_ptr streets, world::vehicle_params car,
              free_drive drive)
      : streets_{std::move(streets)}, car_{car}, drive_{std::move(drive)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto request = input.what.as<actors::plan_request>();
    const auto way = request ? streets_->find(request->way) : nullptr;
    if (!way)
      return {};
    if (!began_)
      began_ = now;
    const auto& path = way->path();
    const auto t0_s = to_seconds(now - *began_);
    auto s_m = request->from.s_m, v = request->from.speed_mps;
    const auto age_s = to_seconds(now - request->from.at);
    s_m += v * age_s;
    world::trajectory plan;
    plan.start = now;
    for (int k = 0; k <= steps; ++k) {
      const auto a = accel(t0_s + k * step_s, s_m, v, *request);
      const auto lane = path.frame(s_m);
      plan.points.push_back({k * step_s, s_m, lane.at, lane.heading_rad,
                             lane.curvature_1pm, v, a});
      const auto next = std::clamp(v + a * step_s, 0.0, limit_mps);
      s_m += step_s * (v + next) / 2;
      v = next;
    }
    return {messages::payload::of(std::move(plan))};
  }

private:
  static constexpr auto step_s = 0.1;
  static constexpr auto steps = 40;

  double accel(double t_s, double s_m, double v,
               const actors::plan_request& request) const {
    auto a = drive_.at(t_s);
    if (const auto line_m = request.stop_at_m(car_)) {
      const auto left_m = std::max(0.05, *line_m - s_m - car_.front_m - 0.5);
      const auto needed = v * v / (2 * left_m);
      if (needed > 2)
        a = std::min(a, -1.05 * needed);
    }
    if ((v <= 0 && a < 0) || (v >= limit_mps && a > 0))
      return 0;
    return std::max(a, -8.0);
  }

  world::streets_ptr streets_;
  world::vehicle_params car_;
  free_drive drive_;
  std::optional<time_point> began_;
};

class free_in_vehicle final : public offloading::vehicle_service {
public:
  free_in_vehicle(const actors::service_world& world, free_drive drive)
      : world_{world}, drive_{std::move(drive)} {}
  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<free_driver>(world_.streets, world_.car, drive_);
  }

private:
  actors::service_world world_;
  free_drive drive_;
};

actors::service_type_ptr with_free_drivers(actors::service_type_ptr real,
                                           const lottery& of) {
  return std::make_shared<changed_service>(
      std::move(real),
      [of](offloading::service& service, const actors::service_world& world) {
        service.in_vehicle = [real = service.in_vehicle, world,
                              of](const offloading::vehicle_context& who)
            -> std::shared_ptr<offloading::vehicle_service> {
          if (who.station.value() < first_free)
            return real(who);
          return std::make_shared<free_in_vehicle>(
              world, drawn_drive(of.part(who.station.value())));
        };
      });
}

std::string fleet(unsigned station, std::string_view route, double start_m,
                  double speed_mps) {
  return fmt::format("[[fleet]]\nfirst_station = {}\nroutes = [\"{}\"]\n"
                     "start_m = {:.2f}\nstart_speed_mps = {:.2f}\n"
                     "connected = {}\n",
                     station, route, start_m, speed_mps, station < first_free);
}

/// Behind one another on the way from the east, the last one first.
std::string drawn_row(lottery of, int own, double from_m) {
  constexpr planners::rss_motion lon;
  constexpr world::vehicle_params car;
  std::string text;
  auto at_m = from_m;
  auto behind_mps = of.number(0, limit_mps, 2);
  for (int k = own; k > 0; --k) {
    text += fleet(100U + static_cast<unsigned>(k), "ew", at_m, behind_mps);
    const auto ahead_mps = of.number(0, limit_mps, 2);
    const auto needed_m =
        planners::farthest_m(behind_mps, starts_safe_under_s, lon)
        - ahead_mps * ahead_mps / (2 * lon.brake_max_mps2);
    at_m += car.front_m + car.rear_m + std::max(3.1, needed_m)
            + of.spread(0.2, 40, 2);
    behind_mps = ahead_mps;
  }
  return text + fleet(first_free, "ew", at_m, behind_mps);
}

std::string drawn_vehicles(lottery of, scene_kind kind) {
  switch (kind) {
    case scene_kind::follow:
      return drawn_row(of.part("row"), 1, 5);
    case scene_kind::row:
      return drawn_row(of.part("row"), 2, 5);
    case scene_kind::oncoming:
      return drawn_row(of.part("row"), 1, 5)
             + fleet(first_free + 1, "we", of.number(30, 120, 1),
                     of.number(0, limit_mps, 2));
    case scene_kind::granted:
      break;
  }
  return fleet(101, "ew", of.number(30, 70, 1), of.number(3, limit_mps, 2))
         + fleet(first_free, "ns", of.number(30, 80, 1),
                 of.number(3, limit_mps, 2));
}

std::string drawn_air(lottery of, bool is_slow) {
  constexpr std::array<const char*, 3> profiles{"paper_sim", "paper_5g",
                                                "spiky_5g"};
  auto text = fmt::format("[network]\nprofile = \"{}\"\nloss = {:.3f}\n",
                          profiles[static_cast<std::size_t>(of.whole(0, 2))],
                          of.happens(0.5) ? of.spread(0.001, 0.05, 3) : 0.0);
  if (is_slow)
    text += fmt::format("more_delay = \"{}ms\"\nstalls = {{ rate_hz = 0.4, "
                        "shortest = \"800ms\", longest = \"1400ms\" }}\n",
                        of.whole(100, 200));
  else if (of.happens(0.5))
    text += fmt::format("stalls = {{ rate_hz = {:.2f}, shortest = \"50ms\", "
                        "longest = \"{}ms\" }}\n",
                        of.spread(0.1, 1, 2), of.whole(100, 1500));
  return text;
}

constexpr auto slow_limits = "max_latency = \"1s\"\n"
                             "max_input_age = \"1500ms\"\n"
                             "max_interarrival = \"1500ms\"\n";

lottery drawn_by(std::uint64_t seed) {
  return lottery{random_stream{seed, "safe scene"}};
}

// -- the check ----------------------------------------------------------------

/// A vehicle at one instant.
struct instant {
  messages::cam own;
  double s_m = 0, d_m = 0;
  double split_s = 0; // the time that its split may take
  bool away = false;  // a service is at a provider
};

using timeline = std::vector<instant>;
using timelines = std::map<station_id, timeline>;

constexpr auto tick_s = 0.01;

/// Where each service is decides what the split may take.
class split_times {
public:
  explicit split_times(const scenario::scenario_definition& s) {
    for (const auto& type : s.services) {
      const auto& options = type->options;
      times_[messages::service_name{type->name()}] = {
          to_seconds(offloading::own_response(options)),
          to_seconds(offloading::worst_response(options))};
    }
  }

  double home_s() const { return sum_s({}); }

  timelines of(const memory_sink& run, scene_findings& out) const {
    timelines all;
    std::map<station_id, std::vector<messages::service_name>> away;
    auto next = run.events.begin();
    for (const auto& t : run.tracks) {
      for (; next != run.events.end() && next->at <= t.at; ++next)
        if (next->what == messages::event_type::switched) {
          ++out.changes;
          auto& there = away[next->station];
          std::erase(there, next->service);
          if (next->remote)
            there.push_back(next->service);
        }
      const auto station = t.ego.own.station;
      all[station].push_back({t.ego.own, t.ego.s_m, t.lateral_m,
                              sum_s(away[station]), !away[station].empty()});
    }
    return all;
  }

private:
  struct both {
    double home_s, away_s;
  };

  double sum_s(const std::vector<messages::service_name>& away) const {
    auto sum = 0.0;
    for (const auto& [name, takes] : times_)
      sum += std::ranges::count(away, name) > 0 ? takes.away_s : takes.home_s;
    return sum;
  }

  std::map<messages::service_name, both> times_;
};

/// Holds one vehicle against RSS, instant by instant.
class onlooker {
public:
  onlooker(station_id who, const world::route& way, const timelines& all,
           bool granted)
      : who_{who}, way_{way}, all_{all}, me_{all.at(who)}, granted_{granted} {}

  void look(scene_findings& out) {
    for (std::size_t k = 0; k < me_.size(); ++k) {
      out.driven_s += tick_s;
      out.remote_s += me_[k].away ? tick_s : 0;
      if (safe_s(k) >= me_[k].split_s)
        less_.reset();
      else
        on_less(k, out);
    }
  }

  /// @returns the longest safe response time at an instant; with others who
  /// have kept their speed since the one before, if `kept`.
  double safe_s(std::size_t k, bool kept = false) const {
    std::vector<world::perceived_object> objects;
    for (const auto& [station, line] : all_) {
      if (station == who_ || k >= line.size())
        continue;
      const auto& x = line[kept ? k - 1 : k].own;
      const point axis{std::cos(x.heading_rad), std::sin(x.heading_rad)};
      const auto middle_m =
          (car_.front_m - car_.rear_m) / 2 + (kept ? x.speed_mps * tick_s : 0);
      objects.push_back({x.position + middle_m * axis, x.heading_rad,
                         x.speed_mps, x.accel_mps2, car_.front_m + car_.rear_m,
                         car_.width_m});
    }
    const auto& me = me_[k];
    const auto turned_rad =
        wrap_angle(me.own.heading_rad - way_.path().at(me.s_m).heading_rad);
    return planners::longest_safe_response({way_, me.s_m, me.d_m, turned_rad,
                                            me.own.speed_mps, objects,
                                            std::nullopt, granted_},
                                           assumed_, car_, 5)
        .longest_s;
  }

private:
  /// Since when it is less, and by when the car has to brake.
  struct stretch {
    double since_s, until_s;
    bool from_home, told;
  };

  void on_less(std::size_t k, scene_findings& out) {
    const auto& me = me_[k];
    const auto t_s = tick_s * static_cast<double>(k);
    out.less_s += tick_s;
    if (!less_)
      begin(k, out);
    const auto brakes =
        me.own.accel_mps2 <= -(assumed_.lon.brake_min_mps2 - 0.05)
        || me.own.speed_mps < 0.05;
    if (brakes || t_s <= less_->until_s)
      return;
    if (!less_->from_home)
      out.latest_s = std::max(out.latest_s, t_s - less_->until_s);
    if (std::exchange(less_->told, true))
      return;
    ++(less_->from_home ? out.home_late : out.late);
    tell(k, "late", out);
  }

  // It may take the time of the split that was in use, as when it has just come
  // home.
  void begin(std::size_t k, scene_findings& out) {
    const auto& me = me_[k];
    const auto& before = me_[k > 0 ? k - 1 : 0];
    const auto t_s = tick_s * static_cast<double>(k);
    less_ = {t_s, t_s + std::max(before.split_s, me.split_s),
             !me.away && !before.away, false};
    ++out.less;
    if (me.split_s > before.split_s) {
      ++out.entered;
      tell(k, "entered", out);
    } else {
      out.others += k == 0 || safe_s(k, true) >= me.split_s;
    }
  }

  void tell(std::size_t k, std::string_view what, scene_findings& out) const {
    const auto& me = me_[k];
    // A brake that was late counts for more than a service away from home.
    if (out.first.empty() || (what == "late" && !out.first.starts_with(what)))
      out.first = fmt::format(
          "{}: vehicle {} at {:.2f} s, less since {:.2f} s, {}, {:.1f} m/s, "
          "{:.1f} m/s2, safe under {:.3f} s",
          what, who_, tick_s * static_cast<double>(k), less_->since_s,
          me.away ? "away" : "at home", me.own.speed_mps, me.own.accel_mps2,
          safe_s(k));
  }

  station_id who_;
  const world::route& way_;
  const timelines& all_;
  const timeline& me_;
  bool granted_;
  planners::rss_assumptions assumed_;
  world::vehicle_params car_;
  std::optional<stretch> less_;
};

} // namespace

void scene_findings::add(const scene_findings& x) {
  scenes += x.scenes;
  passed_over += x.passed_over;
  collisions += x.collisions;
  changes += x.changes;
  driven_s += x.driven_s;
  remote_s += x.remote_s;
  less_s += x.less_s;
  less += x.less;
  entered += x.entered;
  others += x.others;
  late += x.late;
  home_late += x.home_late;
  latest_s = std::max(latest_s, x.latest_s);
}

scene_kind kind_of(std::uint64_t seed) {
  return static_cast<scene_kind>(
      drawn_by(seed).part("kind").whole(0, scene_kinds - 1));
}

std::string_view name_of(scene_kind kind) {
  constexpr std::array<std::string_view, scene_kinds> names{
      "follow", "row", "oncoming", "granted"};
  return names[static_cast<std::size_t>(kind)];
}

std::string scene_text(std::uint64_t seed, const scene_policy& how) {
  const auto of = drawn_by(seed);
  auto text = fmt::format(
      "name = \"scene\"\nduration = \"{}s\"\nseed = {}\n"
      "map = \"maps/four_arms.toml\"\n"
      "[sensors]\nocclusion = false\nrange_m = 150.0\n"
      "[record]\ntracks_period = \"10ms\"\ncycles = false\n"
      "[policies]\ncodm = \"always\"\n[policies.lodm]\n{}"
      "[[provider]]\nposition_m = [0.0, 0.0]\narea_radius_m = 500.0\n",
      lasts_s, seed,
      how.lodm == "rss" ? std::string{"name = \"location\"\n"
                                      "govern = [ { name = \"rss\" } ]\n"}
                        : fmt::format("name = \"{}\"\n", how.lodm));
  if (how.is_chain)
    text += "[[service]]\nname = \"tracking\"\n"
            "[[service]]\nname = \"environment_model\"\n";
  text += fmt::format("[[service]]\nname = \"{}\"\nrss = {{ proper_response = "
                      "\"{}ms\" }}\n{}{}",
                      planning_name,
                      how.is_plain   ? 0
                      : how.is_chain ? 450
                                     : 350,
                      how.is_chain ? "input_period = \"50ms\"\n" : "",
                      how.is_slow ? slow_limits : "");
  return text + drawn_air(of.part("air"), how.is_slow)
         + drawn_vehicles(of.part("vehicles"), kind_of(seed));
}

scene_findings drive_scene(std::uint64_t seed, const scene_policy& how) {
  auto s = scenario::parse_scenario(scene_text(seed, how),
                                    SOFOF_SOURCE_DIR "/config/scene.toml", {});
  const split_times times{s};
  for (auto& type : s.services)
    if (type->name() == planning_name)
      type = with_free_drivers(type, drawn_by(seed).part("drives"));
  const auto run = play(s);
  scene_findings out;
  const auto all = times.of(run, out);
  std::vector<std::pair<station_id, world::route_ptr>> looked_at;
  for (const auto& v : scenario::place_vehicles(s))
    if (v.station.value() < first_free)
      looked_at.emplace_back(v.station, v.way);
  for (const auto& [who, way] : looked_at)
    if (onlooker{who, *way, all, true}.safe_s(0)
        < times.home_s() + world::vehicle_params{}.drive_lag_s)
      return {.passed_over = 1};
  for (const auto& [who, way] : looked_at)
    onlooker{who, *way, all, true}.look(out);
  out.scenes = 1;
  out.collisions = static_cast<int>(run.collisions.size());
  return out;
}

} // namespace sofof::test
