// Planning in the vehicle: from what it sees itself.
#include "actors/services/planning/onboard_planning.hpp"

#include "actors/services/planning/plan_cycle.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/scene_look.hpp"
#include "base/protocol.hpp"
#include "planners/safety/proper_response.hpp"
#include "planners/scene/object_tracker.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

class onboard_planning final : public offloading::service_function {
public:
  onboard_planning(planning_world_ptr world,
                   offloading::vehicle_context vehicle)
      : world_{std::move(world)}, vehicle_{std::move(vehicle)},
        model_{planners::noise_of(world_->eyes)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return {};
    auto from = planners::made_possible(request->from);
    const auto in_use = input.in_use.as<world::trajectory>();
    // Who stands by begins on the plan in use, and is not driven by.
    if (drives_by_another_ || input.standby)
      cycle_->forget_plan();
    drives_by_another_ = input.standby;
    const auto& own = cycle_->plan();
    if (in_use && in_use->is_sound()
        && (own.empty() || in_use->start > own.start))
      cycle_->take_over(*in_use);
    else if (own.empty() || now > own.end())
      from.accel_mps2 =
          std::clamp(from.accel_mps2, -style().comfort_decel_mps2,
                     style().max_accel_mps2); // none of its own so far
    const auto report = plan(now, *request, std::move(from));
    if (!input.standby)
      keep_safe(input);
    return {messages::payload::of(cycle_->plan()),
            messages::payload::of(report)};
  }

  offloading::begun_cycle begin(time_point now,
                                const messages::service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return offloading::service_output{};
    return [this, now, input] { return run(now, input); };
  }

  void observe(time_point now, const messages::service_input& input) override {
    drives_by_another_ = true;
    const auto request = input.what.as<plan_request>();
    if (request && !request->found.scene)
      take_in(now, *request);
  }

private:
  // From what is known of the others: by this function itself, unless that is
  // the business of services before it.
  planners::plan_report plan(time_point now, const plan_request& request,
                             planners::planning_input from) {
    const auto* scene = request.found.scene.get();
    if (scene && !scene->made_of)
      from.others = scene->scene;
    from.others.stop_at_m = request.stop_at_m(world_->car);
    std::span<const planners::told_drive> told;
    if (const auto* agreed_on = request.crossing.get()) {
      from.others.agreed =
          planners::agreed(*agreed_on, now, request.agreeing(world_->car));
      told = agreed_on->told;
    }
    if (scene && !scene->made_of)
      return cycle_->run_in_scene(now, from);
    if (!scene)
      take_in(now, request);
    return cycle_->run(now, std::move(from),
                       scene ? std::span{scene->made_of->all} : model_.tracks(),
                       told);
  }

  // Planners brake as softly as they can, and keep distances of their own.
  void keep_safe(const messages::service_input& input) {
    const auto within = world_->proper_response;
    if (within == duration{} || !cycle_->plan().is_sound())
      return;
    const auto scene = look_at(input, *world_);
    if (!scene || scene->longest >= within)
      return;
    auto plan = cycle_->plan();
    planners::respond_properly(plan, world_->rss.lon.brake_min_mps2);
    cycle_->take_over(plan);
  }

  const planners::comfort_limits& style() const {
    return world_->options.style;
  }

  bool prepare(const std::string& name) {
    if (cycle_ && cycle_->way()->name() == name)
      return true;
    const auto way = world_->streets->find(name);
    if (way)
      cycle_.emplace(*world_, vehicle_.station, stopwatch_of(vehicle_), false,
                     way);
    return way != nullptr;
  }

  // Every sight counts once.
  void take_in(time_point now, const plan_request& request) {
    const auto& seen = request.seen;
    if (seen.at == taken_in_ || protocol::is_of_future(seen.at, now))
      return;
    taken_in_ = seen.at;
    model_.update(seen.at, seen.objects, request.own.position);
  }

  planning_world_ptr world_;
  offloading::vehicle_context vehicle_;
  planners::object_tracker model_;
  std::optional<time_point> taken_in_;
  std::optional<plan_cycle> cycle_;
  bool drives_by_another_ = false; // source: the own plan is an old one
};

} // namespace

std::shared_ptr<offloading::service_function>
make_onboard_planning(planning_world_ptr world,
                      offloading::vehicle_context vehicle) {
  return std::make_shared<onboard_planning>(std::move(world),
                                            std::move(vehicle));
}

} // namespace sofof::actors
