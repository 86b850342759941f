// Runs in which each vehicle has, beside its chain of services, another one
// that never leaves it: what the first gives after it has come home is held
// against what that one would have given.
#pragma once

#include "actors/services/planning/plan_request.hpp"
#include "actors/services/service_type.hpp"
#include "actors/simulation/service_client.hpp"
#include "scenario/build.hpp"
#include "scenario/runtime.hpp"
#include "scenario/scenario.hpp"
#include "tests/support/memory_sink.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::test {

inline constexpr double not_the_same = 1e9; // m

/// What the vehicle's own planner made, and what one that never left would
/// have made of the same looks.
struct home_plan {
  bool is_whole = false; ///< Of its own scene, and that of its own tracks.
  /// The farthest; as here: not the same ones, or not known.
  double tracks_apart_m = not_the_same;
  double scene_apart_m = not_the_same; ///< Likewise of others on the way.
  double plan_apart_m = not_the_same;  ///< Likewise in the first two seconds.
};

/// A plan that a vehicle went by.
struct used_plan {
  time_point at; ///< From then on.
  bool remote = false;
  time_point start; ///< Of the plan.
};

/// One vehicle's chain that never leaves it, and what it was compared with.
struct watched_vehicle {
  std::map<std::string, std::shared_ptr<offloading::service_function>> stays;
  /// What that chain has found; by the look, and by the moment it describes.
  std::map<time_point, std::shared_ptr<const actors::known_tracks>> tracks;
  std::map<time_point, std::shared_ptr<const actors::known_scene>> scenes;
  /// The latest that the vehicle's own tracking has found.
  std::deque<std::shared_ptr<const actors::known_tracks>> own_tracks;
  messages::payload in_use; ///< Plan, as a provider was told.
  /// The latest plan of its own planner; null: it does not go on from that.
  std::shared_ptr<const world::trajectory> own;
  std::map<time_point, home_plan> plans; ///< By their start.
  std::vector<used_plan> used;
};

struct watched_run {
  std::map<station_id, watched_vehicle> vehicles;
  std::function<time_point()> clock;
  memory_sink records;
};

// -- how far apart ------------------------------------------------------------

inline double apart_m(const std::vector<planners::track>& a,
                      const std::vector<planners::track>& b) {
  if (a.size() != b.size())
    return not_the_same;
  double most = 0;
  for (const auto& x : a) {
    double least = not_the_same;
    for (const auto& y : b)
      least = std::min(least, distance_m(x.centre(), y.centre()));
    most = std::max(most, least);
  }
  return most;
}

inline double apart_m(const planners::driving_scene& a,
                      const planners::driving_scene& b) {
  if (a.lead.has_value() != b.lead.has_value()
      || a.crossings.size() != b.crossings.size()
      || a.beside.size() != b.beside.size())
    return not_the_same;
  double most = a.lead ? std::abs(a.lead->rear_s_m - b.lead->rear_s_m) : 0;
  for (std::size_t k = 0; k < a.crossings.size(); ++k)
    most =
        std::max(most, std::abs(a.crossings[k].from_m - b.crossings[k].from_m));
  for (std::size_t k = 0; k < a.beside.size(); ++k)
    most = std::max(most, std::abs(a.beside[k].from_m - b.beside[k].from_m));
  return most;
}

/// In the first two seconds.
inline double apart_m(const world::trajectory& a, const world::trajectory& b) {
  if (a.empty() || b.empty())
    return not_the_same;
  double most = 0;
  for (auto t = a.start; t <= a.start + std::chrono::seconds{2};
       t += std::chrono::milliseconds{100})
    most = std::max(most, distance_m(a.at(t).at, b.at(t).at));
  return most;
}

// -- services that are watched ------------------------------------------------

/// A vehicle's own function: each call goes to the one that never leaves, too.
class watched_function final : public offloading::service_function {
public:
  watched_function(std::shared_ptr<offloading::service_function> real,
                   std::string name, watched_vehicle& vehicle)
      : real_{std::move(real)}, name_{std::move(name)}, vehicle_{vehicle} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto before = goes_on_from(input);
    auto made = real_->run(now, input);
    if (auto x = made.what.as<actors::known_tracks>()) {
      vehicle_.own_tracks.push_back(std::move(x));
      if (vehicle_.own_tracks.size() > most_kept)
        vehicle_.own_tracks.pop_front();
    }
    follow(now, input, before, &made);
    return made;
  }
  void observe(time_point now, const messages::service_input& input) override {
    real_->observe(now, input);
    follow(now, input, vehicle_.in_use, nullptr);
    if (name_ == "trajectory_planning")
      vehicle_.own.reset();
  }

private:
  static constexpr std::size_t most_kept = 40;

  /// @returns the plan that the own planner goes on from.
  messages::payload goes_on_from(const messages::service_input& input) const {
    const auto in_use = input.in_use.as<world::trajectory>();
    const auto& own = vehicle_.own;
    if (own && !input.standby && !(in_use && in_use->start > own->start))
      return messages::payload::of(world::trajectory{*own});
    return input.in_use;
  }

  /// @param made  By the vehicle's own function; null: it has only observed.
  void follow(time_point now, const messages::service_input& input,
              const messages::payload& plan, offloading::service_output* made) {
    const auto request = input.what.as<actors::plan_request>();
    if (!request)
      return;
    auto mine = *request;
    auto in = input;
    if (name_ == "environment_model")
      mine.found.tracks = tracks_like(request->found.tracks);
    if (name_ == "trajectory_planning") {
      mine.found.scene = scene_like(request->found.scene);
      in.in_use = plan;
      in.standby = true; // it never goes on from a plan that was not used
    }
    in.what = messages::payload::of(actors::plan_request{mine});
    const auto stayed = vehicle_.stays.at(name_)->run(now, in).what;
    if (auto x = stayed.as<actors::known_tracks>())
      keep(vehicle_.tracks, request->seen.at, std::move(x));
    if (auto x = stayed.as<actors::known_scene>())
      keep(vehicle_.scenes, x->scene.at, x);
    const auto here = made ? made->what.as<world::trajectory>() : nullptr;
    const auto there = stayed.as<world::trajectory>();
    if (!here || !there)
      return;
    vehicle_.own = input.standby ? nullptr : here;
    compare(now, *request, mine, *here, *there);
  }

  void compare(time_point now, const actors::plan_request& request,
               const actors::plan_request& mine, const world::trajectory& here,
               const world::trajectory& there) {
    home_plan found;
    const auto& scene = request.found.scene;
    found.is_whole = scene && request.found.scene_by == 0
                     && std::ranges::find(vehicle_.own_tracks, scene->made_of)
                            != vehicle_.own_tracks.end();
    if (found.is_whole && mine.found.scene) {
      found.tracks_apart_m =
          apart_m(scene->made_of->all, mine.found.scene->made_of->all);
      found.scene_apart_m = apart_m(scene->scene, mine.found.scene->scene);
    }
    found.plan_apart_m = apart_m(here, there);
    vehicle_.plans[now] = found;
  }

  template <class T>
  static void keep(std::map<time_point, std::shared_ptr<const T>>& all,
                   time_point at, std::shared_ptr<const T> what) {
    all[at] = std::move(what);
    if (all.size() > most_kept)
      all.erase(all.begin());
  }

  /// @returns those of the same look, or the newest.
  std::shared_ptr<const actors::known_tracks>
  tracks_like(const std::shared_ptr<const actors::known_tracks>& known) const {
    const auto& all = vehicle_.tracks;
    if (all.empty())
      return nullptr;
    if (known && !known->all.empty())
      if (const auto i = all.find(known->all.front().at); i != all.end())
        return i->second;
    return all.rbegin()->second;
  }

  /// @returns that of the same moment, or the newest.
  std::shared_ptr<const actors::known_scene>
  scene_like(const std::shared_ptr<const actors::known_scene>& known) const {
    const auto& all = vehicle_.scenes;
    if (all.empty())
      return nullptr;
    if (known)
      if (const auto i = all.find(known->scene.at); i != all.end())
        return i->second;
    return all.rbegin()->second;
  }

  std::shared_ptr<offloading::service_function> real_;
  std::string name_;
  watched_vehicle& vehicle_;
};

class watched_in_vehicle final : public offloading::vehicle_service {
public:
  watched_in_vehicle(std::shared_ptr<offloading::vehicle_service> real,
                     std::string name, watched_vehicle& vehicle)
      : real_{std::move(real)}, name_{std::move(name)}, vehicle_{vehicle} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    vehicle_.stays[name_] = real_->make_function();
    return std::make_shared<watched_function>(real_->make_function(), name_,
                                              vehicle_);
  }
  messages::service_input encode_input(messages::service_input input,
                                       bool takes_over) const override {
    if (input.in_use.as<world::trajectory>())
      vehicle_.in_use = input.in_use;
    return real_->encode_input(std::move(input), takes_over);
  }
  bool continues(const messages::payload& in_use,
                 const messages::payload& offered,
                 time_point now) const override {
    return real_->continues(in_use, offered, now);
  }
  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return real_->make_judge();
  }
  std::optional<offloading::safe_response>
  look_at_scene(const messages::service_input& latest) const override {
    return real_->look_at_scene(latest);
  }
  messages::payload
  termination_message(const messages::service_end& end, time_point now,
                      const messages::cam& own) const override {
    return real_->termination_message(end, now, own);
  }

private:
  std::shared_ptr<offloading::vehicle_service> real_;
  std::string name_;
  watched_vehicle& vehicle_;
};

/// Tells which plans vehicles go by, and when.
class watched_plans final : public actors::plan_client {
public:
  watched_plans(std::shared_ptr<const actors::plan_client> real,
                watched_run& run)
      : real_{std::move(real)}, run_{run} {}

  messages::payload ask(const world::route& way,
                        const planners::planning_input& from,
                        const world::perception& seen, const messages::cam& own,
                        const messages::payload& crossing) const override {
    return real_->ask(way, from, seen, own, crossing);
  }
  std::optional<actors::received_plan>
  read(const messages::service_result& result) const override {
    auto plan = real_->read(result);
    if (plan)
      run_.vehicles[result.session.station].used.push_back(
          {run_.clock(), result.session.is_remote(), plan->plan->start});
    return plan;
  }

private:
  std::shared_ptr<const actors::plan_client> real_;
  watched_run& run_;
};

class watched_service final : public actors::service_type {
public:
  watched_service(actors::service_type_ptr real, watched_run& run)
      : real_{std::move(real)}, run_{run} {
    options = real_->options;
  }

  std::string_view name() const override { return real_->name(); }
  void visit_options(option_visitor& s) override { real_->visit_options(s); }
  std::string_view follows() const override { return real_->follows(); }
  offloading::service in(const actors::service_world& world) const override {
    auto made = real_->in(world);
    made.in_vehicle = [real = made.in_vehicle, name = std::string{name()},
                       &run = run_](const offloading::vehicle_context& where) {
      return std::make_shared<watched_in_vehicle>(real(where), name,
                                                  run.vehicles[where.station]);
    };
    return made;
  }
  actors::service_client
  spawn_client(const actors::client_place& where) const override {
    return real_->spawn_client(where);
  }
  std::shared_ptr<const actors::plan_client> plans() const override {
    auto real = real_->plans();
    return real ? std::make_shared<watched_plans>(std::move(real), run_)
                : nullptr;
  }

private:
  actors::service_type_ptr real_;
  watched_run& run_;
};

/// @returns what came of a whole run, in virtual time, with each step of the
/// protocol.
inline std::unique_ptr<watched_run> watch(scenario::scenario_definition s) {
  auto run = std::make_unique<watched_run>();
  s.record.trace = true;
  for (auto& type : s.services)
    type = std::make_shared<watched_service>(type, *run);
  auto records = std::make_shared<memory_sink>();
  const auto time = scenario::make_virtual_runtime();
  run->clock = [&time] { return time->now(); };
  const auto actors =
      scenario::build(time->system(), s, records, time->clock(), true);
  time->run_until(time->now() + s.length);
  scenario::dismiss(actors, *time);
  run->clock = nullptr;
  run->records = std::move(*records);
  return run;
}

// -- changes ------------------------------------------------------------------

/// The last service of a vehicle's chain has come home.
struct change_home {
  station_id station = 0;
  time_point at;
  std::string reason;
  /// Until the first plan of its own tracks and scene was in use; nullopt: the
  /// run was over, or a service had left again.
  std::optional<duration> first{};
  std::optional<duration> left{}; ///< Until a service left again, if any did.
  home_plan plan{};               ///< That one.
};

/// @returns all of them, by time.
inline std::vector<change_home> changes_home(const watched_run& run) {
  std::map<station_id, std::map<std::string, bool>> remote;
  std::vector<change_home> all;
  std::map<station_id, std::string> why;
  for (const auto& step : run.records.steps) {
    if (step.by != messages::trace_part::selector)
      continue;
    if (step.what == messages::trace_step::end_got)
      why[step.station] = step.detail;
    if (step.what != messages::trace_step::source)
      continue;
    const auto& [name, counter] = step.services.front();
    auto& of = remote[step.station];
    of[std::string{name.view()}] = counter != 0;
    const auto is_home =
        std::ranges::none_of(of, [](const auto& x) { return x.second; });
    if (is_home && counter == 0)
      all.push_back({step.station, step.at, why[step.station]});
    else if (!all.empty()) // leaves again: nothing is measured beyond
      for (auto& x : all)
        if (x.station == step.station && !x.left)
          x.left = step.at - x.at;
  }
  for (auto& x : all) {
    const auto& vehicle = run.vehicles.at(x.station);
    for (const auto& used : vehicle.used) {
      if (used.at < x.at || used.remote)
        continue;
      if (x.left && used.at - x.at >= *x.left)
        break;
      const auto made = vehicle.plans.find(used.start);
      if (made == vehicle.plans.end() || !made->second.is_whole)
        continue;
      x.first = used.at - x.at;
      x.plan = made->second;
      break;
    }
  }
  return all;
}

} // namespace sofof::test
