// Drives vehicles whose provider lies, for tests/acceptance/trust and traffic.
//
//   lies drive LIE SEED yes|no SECONDS   in virtual time, with or without
//                                        other traffic; prints a line of
//                                        figures: NAME=VALUE ...
//   lies chain LIE OFFERED SEED SECONDS
//                                        the same of a chain: LIE is also one
//                                        about tracks or scenes, or `none`;
//                                        OFFERED names the services at the
//                                        provider, with commas between
//   lies provide LIE SCENARIO HOST:PORT KEYS SECONDS OUT
//                                        as `sofof provide`, over TLS
//   lies conduct LIE SCENARIO AFTER_MS   runs it, in virtual time, with servers
//                                        that lie about crossings, some time
//                                        after each vehicle's first advice
//   lies time SCENARIO SECONDS           judges honest plans, in virtual time;
//                                        prints what a plan takes, µs
#include "experiments/torture/changed_service.hpp"
#include "experiments/torture/lying_chain.hpp"
#include "experiments/torture/lying_planning.hpp"
#include "network/network_address.hpp"
#include "scenario/hosts.hpp"
#include "scenario/init_messages.hpp"
#include "scenario/load.hpp"
#include "scenario/placement.hpp"
#include "tests/scenario/whole_run.hpp"
#include "tests/support/judging_times.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <string>
#include <string_view>

using namespace sofof;
using namespace std::chrono_literals;
using namespace sofof::actors;
using namespace sofof::experiments::torture;
using namespace sofof::messages;
using namespace sofof::network;
using namespace sofof::planners;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace sofof::world;

namespace {

constexpr auto planning = "trajectory_planning";
constexpr auto conducting = "crossing_management";

/// Three connected cars in a row on the round trip through Ulm-Lehr, a pair
/// that comes towards them, and, if wanted, twelve more that do not talk.
/// @param more  Of the scenario's text.
scenario_definition scene(std::uint64_t seed, bool traffic, int seconds,
                          std::string_view lodm, std::string_view more) {
  const auto start_m = 30 + static_cast<int>(seed * 37 % 400);
  auto text =
      fmt::format(R"(
name = "lies"
duration = "{}s"
seed = {}
map = "maps/ulm_lehr.toml"
[[fleet]]
count = 3
first_station = 101
routes = ["round_trip"]
placement = "convoy"
spacing_m = 28.0
start_m = {}.0
[[fleet]]
count = 2
first_station = 104
routes = ["round_trip_opposite"]
placement = "convoy"
spacing_m = 28.0
start_m = {}.0
[policies]
lodm = "{}"
codm = "always"
[record]
tracks_period = "50ms"
{})",
                  seconds, seed, start_m + 100, start_m + 40, lodm, more);
  constexpr auto file = SOFOF_SOURCE_DIR "/config/lies.toml";
  if (!traffic)
    return parse_scenario(text, file);
  // Where they do not stand on others.
  for (int shift_m = 0;; shift_m += 20)
    try {
      const auto others = fmt::format(R"(
[[fleet]]
count = 12
first_station = 201
routes = ["round_trip", "round_trip_opposite"]
start_m = {}.0
connected = false
)",
                                      (start_m + 160 + shift_m) % 400);
      return parse_scenario(text + others, file);
    } catch (const input_error&) {
      if (shift_m > 400)
        throw;
    }
}

constexpr auto one_service = R"(
[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 3000.0
range_m = 5000.0
[[service]]
name = "trajectory_planning"
)";

/// @param offered  Names with commas between: of those of the chain that the
///                 provider offers.
std::string whole_chain(std::string_view offered) {
  std::string names{offered};
  for (auto at = names.find(','); at != std::string::npos;
       at = names.find(',', at + 3))
    names.replace(at, 1, "\",\"");
  return fmt::format(R"(
[traffic]
crossings = "perceived"
[[provider]]
name = "mec"
position_m = [0.0, 0.0]
area_radius_m = 3000.0
range_m = 5000.0
services = ["{}"]
[[service]]
name = "tracking"
[[service]]
name = "environment_model"
[[service]]
name = "trajectory_planning"
input_period = "50ms"
)",
                     names);
}

/// A stretch of time in which something goes on, and the longest so far.
struct stretch {
  double now_s = 0, longest_s = 0;
  void add(bool goes_on, double dt_s) {
    now_s = goes_on ? now_s + dt_s : 0;
    longest_s = std::max(longest_s, now_s);
  }
};

struct figures {
  double beyond_m = -1e9; ///< The farthest out of the lane.
  double outside_s = 0;   ///< The longest time in a row.
  double braking_s = 0;   ///< Below -4.5 m/s² with no body ahead, in a row.
  double least_accel_mps2 = 0;
  double over_mps = -1e9;   ///< Over 1.1 limit + 0.8 m/s.
  double late_s = 0;        ///< Of the latest car against driving alone.
  double back_ms = 0;       ///< From a refused result to the own plan.
  std::size_t requests = 0; ///< The most of any vehicle.
  std::size_t refused = 0;
  std::size_t collisions = 0;
  std::map<std::string, std::size_t> checks;
};

constexpr vehicle_params body_size;

/// @returns whether a body is before a car, on its lane or next to it, or
/// where its way is crossed.
bool any_ahead(const track_record& me, const route& way,
               const std::map<station_id, const track_record*>& others) {
  for (const auto& [station, other] : others) {
    if (station == me.ego.own.station)
      continue;
    const auto to = other->ego.own.position - me.ego.own.position;
    if (dot(to, to) > 60.0 * 60.0)
      continue;
    const auto foot =
        way.path().project(other->ego.own.position, me.ego.s_m + 20, 60);
    const auto turned = std::cos(other->ego.own.heading_rad
                                 - way.path().at(foot.s_m).heading_rad);
    const auto beside_m = std::abs(turned) > 0.8 ? 2.9 : 12.0;
    if (foot.s_m > me.ego.s_m && std::abs(foot.d_m) < beside_m)
      return true;
  }
  return false;
}

figures measure(const scenario_definition& s, const memory_sink& lied,
                const memory_sink& alone) {
  figures out;
  std::map<station_id, route_ptr> ways;
  for (const auto& v : place_vehicles(s))
    ways[v.station] = v.way;
  const auto dt_s = to_seconds(s.record.tracks_period);

  std::map<station_id, std::vector<const track_record*>> tracks, usual;
  for (const auto& t : lied.tracks)
    tracks[t.ego.own.station].push_back(&t);
  for (const auto& t : alone.tracks)
    usual[t.ego.own.station].push_back(&t);
  std::map<time_point, std::map<station_id, const track_record*>> moments;
  const auto moment = [&](time_point t) {
    const auto n = t.time_since_epoch() / s.record.tracks_period;
    return time_point{n * s.record.tracks_period};
  };
  for (const auto& t : lied.tracks)
    moments[moment(t.at)][t.ego.own.station] = &t;

  for (const auto& [station, all] : tracks) {
    if (station >= 200)
      continue;
    const auto& way = *ways.at(station);
    stretch outside, braking;
    for (const auto* t : all) {
      const auto& own = t->ego.own;
      const point axis{std::cos(own.heading_rad), std::sin(own.heading_rad)};
      const auto front =
          way.path().project(own.position + body_size.wheelbase_m * axis,
                             t->ego.s_m + body_size.wheelbase_m, 2);
      const auto beyond_m =
          std::max(std::abs(t->lateral_m), std::abs(front.d_m))
          + body_size.width_m / 2 - way.half_width_m(t->ego.s_m);
      out.beyond_m = std::max(out.beyond_m, beyond_m);
      outside.add(beyond_m > 0, dt_s);
      out.over_mps =
          std::max(out.over_mps,
                   own.speed_mps - (1.1 * way.limit_mps(t->ego.s_m) + 0.8));
      out.least_accel_mps2 = std::min(out.least_accel_mps2, own.accel_mps2);
      braking.add(own.accel_mps2 < -4.5
                      && !any_ahead(*t, way, moments[moment(t->at)]),
                  dt_s);
    }
    out.outside_s = std::max(out.outside_s, outside.longest_s);
    out.braking_s = std::max(out.braking_s, braking.longest_s);
    const auto reached_m = all.back()->ego.s_m;
    const auto& before = usual[station];
    const auto there = std::ranges::find_if(
        before, [&](const auto* t) { return t->ego.s_m >= reached_m; });
    if (there != before.end())
      out.late_s =
          std::max(out.late_s, to_seconds(all.back()->at - (*there)->at));
  }

  std::map<station_id, std::size_t> requests;
  for (const auto& e : lied.events) {
    if (e.what == event_type::request && e.service == service_name{planning})
      out.requests = std::max(out.requests, ++requests[e.station]);
    if (e.what != event_type::implausible)
      continue;
    ++out.refused;
    ++out.checks[e.detail.substr(0, e.detail.find(' '))];
    const auto was_remote =
        std::ranges::any_of(lied.episodes, [&](const episode_record& x) {
          return x.of == side::requester && x.got_data
                 && x.session.station == e.station && x.ended == e.at;
        });
    const auto own = std::ranges::find_if(
        lied.plan_switches, [&](const plan_switch_record& x) {
          return x.session.station == e.station && !x.remote && x.at >= e.at;
        });
    const auto back = own != lied.plan_switches.end();
    const auto ends_before = lied.tracks.back().at - e.at < 150ms;
    if (was_remote && (back || !ends_before))
      out.back_ms =
          std::max(out.back_ms, back ? 1e3 * to_seconds(own->at - e.at) : 1e9);
  }
  out.collisions = lied.collisions.size();
  return out;
}

std::string list_counts(const std::map<std::string, std::size_t>& checks) {
  std::string all;
  for (const auto& [check, count] : checks)
    all += fmt::format("{}{}:{}", all.empty() ? "" : ",", check, count);
  return all.empty() ? "none" : all;
}

int drive(lie what, std::uint64_t seed, bool traffic, int seconds) {
  const auto alone = play(scene(seed, traffic, seconds, "never", one_service));
  auto s = scene(seed, traffic, seconds, "always", one_service);
  for (auto& kind : s.services)
    if (kind->name() == planning)
      kind = lying_service(kind, what);
  const auto lied = play(s);
  const auto x = measure(s, lied, alone);
  fmt::print(
      "lie={} seed={} traffic={} seconds={} collisions={} beyond_m={:.2f} "
      "outside_s={:.2f} braking_s={:.2f} least_accel_mps2={:.2f} "
      "over_mps={:.2f} late_s={:.2f} back_ms={:.1f} requests={} "
      "refused={} checks={}\n",
      lie_names[static_cast<std::size_t>(what)], seed, traffic ? "yes" : "no",
      seconds, x.collisions, x.beyond_m, x.outside_s, x.braking_s,
      x.least_accel_mps2, x.over_mps, x.late_s, x.back_ms, x.requests,
      x.refused, list_counts(x.checks));
  return 0;
}

/// Lets a car stand in the way of the first ones: who is not told of it, or
/// elsewhere, drives into it.
/// @param to_right_m  Of the middle of their lane.
void put_in_the_way(scenario_definition& s, double to_right_m) {
  constexpr double ahead_m = 120, clear_m = 12;
  const auto placed = place_vehicles(s);
  const auto& first = placed.front();
  const auto& path = first.way->path();
  for (auto at_m = first.start_s_m + ahead_m;; at_m += clear_m) {
    const auto here = path.at(at_m);
    const point left{-std::sin(here.heading_rad), std::cos(here.heading_rad)};
    const auto is_near = [&](const auto& v) {
      return distance_m(v.way->path().at(v.start_s_m).at, here.at) < clear_m;
    };
    if (std::ranges::any_of(placed, is_near))
      continue;
    s.obstacles.push_back(
        {.position_m = here.at + -to_right_m * left,
         .heading_deg = here.heading_rad * 180 / std::numbers::pi});
    return;
  }
}

/// @param what  A lie about plans, tracks or scenes, or none.
int drive_chain(std::string_view what, std::string_view offered,
                std::uint64_t seed, int seconds) {
  auto s = scene(seed, true, seconds, "always", whole_chain(offered));
  // In the middle, or where it leaves hardly room enough, or room to pass it.
  const auto hardly_m = seed % 2 == 0 ? 1.6 : 0.0;
  put_in_the_way(s, what == "scene_beside_fast" ? 1.8 : hardly_m);
  const auto of_plans = lie_of(what);
  const auto of_chain = chain_lie_of(what);
  const auto told = std::make_shared<std::atomic<std::uint64_t>>(0);
  for (auto& kind : s.services)
    if (of_plans && kind->name() == planning)
      kind = lying_service(kind, *of_plans);
    else if (of_chain && kind->name() == liar_of(*of_chain))
      kind = lying_chain(kind, *of_chain, std::chrono::seconds{8}, told);
  const auto lied = play(s);
  const auto x = measure(s, lied, lied);
  std::map<std::string, std::size_t> used;
  for (const auto& c : lied.cycles)
    used[std::string{c.session.service.view()}] +=
        c.used && c.session.is_remote();
  double without_plan_s = 0;
  for (const auto& car : lied.safety)
    without_plan_s += to_seconds(car.without_fresh_plan);
  fmt::print("lie={} offered={} seed={} seconds={} collisions={} "
             "beyond_m={:.2f} outside_s={:.2f} braking_s={:.2f} "
             "least_accel_mps2={:.2f} over_mps={:.2f} without_plan_s={:.3f} "
             "told={} refused={} used={} checks={}\n",
             what, offered, seed, seconds, x.collisions, x.beyond_m,
             x.outside_s, x.braking_s, x.least_accel_mps2, x.over_mps,
             without_plan_s,
             of_chain ? std::to_string(told->load()) : "unknown", x.refused,
             list_counts(used), list_counts(x.checks));
  return 0;
}

int provide_lies(lie what, const char* file, const char* listen,
                 const char* keys, const char* seconds, const char* out) {
  auto s = load_scenario(
      file, std::vector<std::string>{fmt::format("duration={}s", seconds)});
  for (auto& kind : s.services)
    if (kind->name() == planning)
      kind = lying_service(kind, what);
  provide_options options;
  const auto at = parse_address(listen);
  if (!at)
    return 2;
  options.listen = *at;
  options.keys = keys;
  run_options run;
  run.realtime = true;
  run.whose = "liar";
  run.force = true;
  run.out = out;
  const std::atomic<bool> interrupted{false};
  return static_cast<int>(provide(s, options, run, interrupted, std::cout));
}

int conduct(lie what, const char* file, const char* after_ms) {
  auto s = load_scenario(file, {});
  for (auto& kind : s.services)
    if (kind->name() == conducting)
      kind = lying_service(kind, what,
                           std::chrono::milliseconds{std::atoi(after_ms)});
  const auto x = play(s);
  fmt::print("collisions={} refused={}\n", x.collisions.size(),
             std::ranges::count(x.events, event_type::implausible,
                                &event_record::what));
  return 0;
}

} // namespace

int main(int count, char** words) {
  init_messages();
  const auto what = count > 2 ? lie_of(words[2]) : std::nullopt;
  const std::string_view mode = count > 1 ? words[1] : "";
  try {
    if (what && mode == "drive" && count == 6)
      return drive(*what, std::strtoull(words[3], nullptr, 10),
                   std::string_view{words[4]} == "yes", std::atoi(words[5]));
    if (mode == "chain" && count == 6
        && (what || chain_lie_of(words[2])
            || std::string_view{words[2]} == "none"))
      return drive_chain(words[2], words[3],
                         std::strtoull(words[4], nullptr, 10),
                         std::atoi(words[5]));
    if (what && mode == "provide" && count == 8)
      return provide_lies(*what, words[3], words[4], words[5], words[6],
                          words[7]);
    if (what && mode == "conduct" && count == 5)
      return conduct(*what, words[3], words[4]);
    if (mode == "time" && count == 4)
      return print_judging_times(words[2], words[3]);
  } catch (const std::exception& e) {
    std::cerr << "lies: " << e.what() << "\n";
    return 2;
  }
  std::cerr << "usage: lies drive LIE SEED yes|no SECONDS\n"
               "       lies chain LIE|none OFFERED SEED SECONDS\n"
               "       lies provide LIE SCENARIO HOST:PORT KEYS SECONDS OUT\n"
               "       lies conduct LIE SCENARIO AFTER_MS\n"
               "       lies time SCENARIO SECONDS\n";
  return 2;
}
