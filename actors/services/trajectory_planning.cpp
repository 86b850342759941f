// Trajectory planning as a service: the vehicle is its client; the planner at
// a provider may plan farther and more thoroughly than the vehicle's own.
#include "actors/services/trajectory_planning.hpp"

#include "actors/service_kind.hpp"
#include "actors/services/planning_site.hpp"
#include "planners/lane_follow.hpp"
#include "planners/outlook.hpp"
#include "planners/spatial_planner.hpp"

#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string_view>

namespace sofof {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view optimal_planner = "al_ilqr";
constexpr std::string_view simple_planner = "lane_follow";

/// Which planner, and how it plans.
struct planner_options {
  std::string name{optimal_planner};
  driving_style style;
  spatial_params onboard;
  spatial_params mec{
      .horizon_m = 125, .step_m = 0.5, .candidates = 16, .alternations = 2};

  void fields(settings& s) {
    s.field("name", name);
    if (name != optimal_planner && name != simple_planner)
      s.refuse("name", fmt::format("there is no planner '{}'; choose {} or {}",
                                   name, optimal_planner, simple_planner));
    style.fields(s);
    s.table("onboard", [this](settings& t) { onboard.fields(t); });
    s.table("mec", [this](settings& t) { mec.fields(t); });
  }

  std::unique_ptr<trajectory_planner> make(const route_ptr& way,
                                           bool remote) const {
    if (name == simple_planner)
      return std::make_unique<lane_follow>(way, style);
    return std::make_unique<spatial_planner>(way, style,
                                             remote ? mec : onboard);
  }
};

/// What a planner knows is written down for others so often.
constexpr std::uint64_t cycles_remembered = 5;
/// Trying harder than this helps nobody who waits; only where time is real.
constexpr duration deadline = 2ms;

class planning_function final : public service_function {
public:
  planning_function(service_setup setup, planner_options options,
                    std::shared_ptr<const lane_network> lanes)
      : setup_{std::move(setup)}, options_{std::move(options)},
        lanes_{std::move(lanes)}, site_{
                                      std::dynamic_pointer_cast<planning_site>(
                                          setup_.site)} {}

  payload run(time_point now, const service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return {};
    take_over(input.in_use.as<drive_plan>());
    take_in(now, request->seen);
    auto from = made_possible(request->from);
    describe(now, from, request->seen);
    const auto start = setup_.clock();
    const auto in_time = [&](int) { return setup_.clock() - start < deadline; };
    drive_plan next;
    next.plan.points.reserve(plan_.points.size());
    next.report = planner_->plan(now, from, plan_.empty() ? nullptr : &plan_,
                                 next.plan, ocp::budget{in_time});
    plan_ = next.plan;
    next.memory = remembered();
    return payload::of(std::move(next));
  }

private:
  bool prepare(const std::string& way) {
    if (planner_ && way == way_)
      return true;
    const auto route = setup_.world->find(way);
    if (!route)
      return false;
    planner_ = options_.make(route, setup_.remote);
    outlook_.emplace(
        lanes_, route,
        outlook_params{.judges_crossings = !setup_.crossings_granted});
    plan_ = {};
    memory_ = {};
    cycle_ = 0;
    way_ = way;
    return true;
  }

  // Another source has planned in the meantime.
  void take_over(const std::shared_ptr<const drive_plan>& other) {
    if (!other || !other->plan.is_sound()
        || (!plan_.empty() && other->plan.start <= plan_.start))
      return;
    plan_ = other->plan;
    if (other->memory && is_sound(*other->memory))
      planner_->adopt(*other->memory);
  }

  // It is about places, so it stays good for some cycles.
  std::shared_ptr<const planner_memory> remembered() {
    if (cycle_++ % cycles_remembered == 0) {
      auto memory = std::make_shared<planner_memory>();
      memory_ = planner_->remember(*memory) ? std::move(memory) : nullptr;
    }
    return memory_;
  }

  // What the vehicle sees; every sight counts once.
  void take_in(time_point now, const perception& seen) {
    if (seen.at == taken_in_ || is_of_future(seen.at, now))
      return;
    taken_in_ = seen.at;
    if (site_)
      site_->see(seen.at, seen.objects);
    else
      model_.update(seen.at, seen.objects);
  }

  void describe(time_point now, planning_input& from, const perception& seen) {
    if (site_)
      site_->tracks(tracks_);
    else
      tracks_.assign(model_.tracks().begin(), model_.tracks().end());
    const own_place me{setup_.station, from.s_m, from.d_m};
    outlook_->describe(now, me, tracks_, from.others);
    from.others.stop_at_m = seen.stop_at_m;
  }

  service_setup setup_;
  planner_options options_;
  std::shared_ptr<const lane_network> lanes_;
  std::shared_ptr<planning_site> site_; // null in the vehicle, ...
  environment_model model_;             // which has its own
  std::optional<time_point> taken_in_;
  std::vector<track> tracks_;
  std::string way_;
  std::unique_ptr<trajectory_planner> planner_;
  std::optional<outlook> outlook_;
  std::shared_ptr<const planner_memory> memory_;
  std::uint64_t cycle_ = 0;
  trajectory plan_; // the last one; empty before the first
};

class trajectory_planning final : public service_kind {
public:
  trajectory_planning() {
    // Limits: Dehler & Buchholz 2025. Run time: its table "CPU", simulation
    // column, (19.5 % - 8.5 %) / 20 Hz.
    common.limits = {50ms, 100ms};
    common.period = 50ms;
    common.input_period = 100ms;
    common.run_time_mean = 5500us;
    common.run_time_sd = 2ms;
    common.run_time_max = 45ms;
  }

  std::string_view name() const override { return "trajectory_planning"; }

  void fields(settings& s) override {
    service_kind::fields(s);
    s.table("planner", [this](settings& t) { planner_.fields(t); });
  }

  std::shared_ptr<service_function>
  make_function(const service_setup& setup) const override {
    return std::make_shared<planning_function>(setup, planner_,
                                               lanes(setup.world->map));
  }

  std::shared_ptr<service_site>
  make_site(const service_setup& setup) const override {
    return std::make_shared<planning_site>(setup.clock);
  }

  client_actor spawn_client(caf::actor_system&, const service_setup&,
                            const vehicle_actor& vehicle) const override {
    return vehicle;
  }

private:
  // Found once for all functions, which vehicles make in their own threads.
  std::shared_ptr<const lane_network> lanes(const road_map& map) const {
    const std::lock_guard lock{mutex_};
    if (!lanes_)
      lanes_ = std::make_shared<const lane_network>(map);
    return lanes_;
  }

  planner_options planner_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const lane_network> lanes_;
};

} // namespace

service_kind_ptr make_trajectory_planning() {
  return std::make_shared<trajectory_planning>();
}

} // namespace sofof
