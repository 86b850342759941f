// Trajectory planning as a service: the vehicle is its client, `lane_follow`
// its planner on both sides.
#include "actors/services/trajectory_planning.hpp"

#include "actors/service_kind.hpp"
#include "planners/lane_follow.hpp"

#include <optional>

namespace sofof {

namespace {

using namespace std::chrono_literals;

class planning_function final : public service_function {
public:
  planning_function(streets_ptr world, const driving_style& params)
      : world_{std::move(world)}, params_{params} {}

  payload run(time_point now, const service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return {};
    trajectory next;
    next.points.reserve(plan_ ? plan_->points.size() : 0);
    auto from = request->from;
    const auto& seen = request->seen;
    from.others = {seen.at, seen.lead, seen.stop_at_m, {}, {}};
    planner_->plan(now, from, plan_ ? &*plan_ : nullptr, next);
    plan_ = next;
    return payload::of(std::move(next));
  }

private:
  bool prepare(const std::string& way) {
    if (planner_ && way == way_)
      return true;
    const auto route = world_->find(way);
    if (!route)
      return false;
    planner_.emplace(route, params_);
    plan_.reset();
    way_ = way;
    return true;
  }

  streets_ptr world_;
  driving_style params_;
  std::string way_;
  std::optional<lane_follow> planner_;
  std::optional<trajectory> plan_;
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
    s.table("planner", [this](settings& t) {
      t.field("name", planner_);
      if (planner_ != "lane_follow")
        t.refuse("name",
                 "there is no planner '" + planner_ + "'; choose lane_follow");
      params_.fields(t);
    });
  }

  std::shared_ptr<service_function>
  make_function(const service_setup& setup) const override {
    return std::make_shared<planning_function>(setup.world, params_);
  }

  client_actor spawn_client(caf::actor_system&, const service_setup&,
                            const vehicle_actor& vehicle) const override {
    return vehicle;
  }

private:
  std::string planner_ = "lane_follow";
  driving_style params_;
};

} // namespace

service_kind_ptr make_trajectory_planning() {
  return std::make_shared<trajectory_planning>();
}

} // namespace sofof
