// Trajectory planning as a service: the vehicle is its client; the planner at
// a provider may plan farther and more thoroughly than the vehicle's own.
#include "actors/services/trajectory_planning.hpp"

#include "actors/service_kind.hpp"
#include "planners/lane_follow.hpp"
#include "planners/spatial_planner.hpp"

#include <fmt/format.h>

#include <memory>
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

class planning_function final : public service_function {
public:
  planning_function(const service_setup& setup, planner_options options)
      : world_{setup.world}, remote_{setup.remote}, options_{
                                                        std::move(options)} {}

  payload run(time_point now, const service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return {};
    take_over(input.in_use.as<drive_plan>());
    auto from = request->from;
    const auto& seen = request->seen;
    from.others = {seen.at, seen.lead, seen.stop_at_m, {}, {}};
    drive_plan next;
    next.plan.points.reserve(plan_.points.size());
    next.report =
        planner_->plan(now, from, plan_.empty() ? nullptr : &plan_, next.plan);
    plan_ = next.plan;
    if (auto memory = std::make_shared<planner_memory>();
        planner_->remember(*memory))
      next.memory = std::move(memory);
    return payload::of(std::move(next));
  }

private:
  bool prepare(const std::string& way) {
    if (planner_ && way == way_)
      return true;
    const auto route = world_->find(way);
    if (!route)
      return false;
    planner_ = options_.make(route, remote_);
    plan_ = {};
    way_ = way;
    return true;
  }

  // Another source has planned in the meantime.
  void take_over(const std::shared_ptr<const drive_plan>& other) {
    if (!other || !other->plan.is_sound()
        || (!plan_.empty() && other->plan.start <= plan_.start))
      return;
    plan_ = other->plan;
    if (other->memory)
      planner_->adopt(*other->memory);
  }

  streets_ptr world_;
  bool remote_;
  planner_options options_;
  std::string way_;
  std::unique_ptr<trajectory_planner> planner_;
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
    return std::make_shared<planning_function>(setup, planner_);
  }

  client_actor spawn_client(caf::actor_system&, const service_setup&,
                            const vehicle_actor& vehicle) const override {
    return vehicle;
  }

private:
  planner_options planner_;
};

} // namespace

service_kind_ptr make_trajectory_planning() {
  return std::make_shared<trajectory_planning>();
}

} // namespace sofof
