// Planning in the vehicle: from what it sees itself.
#include "actors/services/planning/onboard_planning.hpp"

#include "actors/services/planning/plan_cycle.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "base/protocol.hpp"
#include "planners/scene/object_tracker.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace sofof {

namespace {

class onboard_planning final : public service_function {
public:
  onboard_planning(service_setup setup, planner_options options,
                   known_roads_ptr roads)
      : setup_{std::move(setup)}, options_{std::move(options)},
        roads_{std::move(roads)} {}

  service_output run(time_point now, const service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !prepare(request->way))
      return {};
    auto from = made_possible(request->from);
    const auto in_use = input.in_use.as<trajectory>();
    const auto& own = cycle_->plan();
    if (in_use && in_use->is_sound()
        && (own.empty() || in_use->start > own.start))
      cycle_->take_over(*in_use);
    else if (own.empty() || now > own.end())
      from.accel_mps2 =
          std::clamp(from.accel_mps2, -options_.style.comfort_decel_mps2,
                     options_.style.max_accel_mps2); // none of its own so far
    take_in(now, request->seen);
    from.others.stop_at_m = request->seen.stop_at_m;
    const auto report = cycle_->run(now, std::move(from), model_.tracks());
    return {payload::of(cycle_->plan()), payload::of(report)};
  }

private:
  bool prepare(const std::string& name) {
    if (cycle_ && cycle_->way()->name() == name)
      return true;
    const auto way = setup_.world->find(name);
    if (way)
      cycle_.emplace(setup_, options_, *roads_, way);
    return way != nullptr;
  }

  // Every sight counts once.
  void take_in(time_point now, const perception& seen) {
    if (seen.at == taken_in_ || protocol::is_of_future(seen.at, now))
      return;
    taken_in_ = seen.at;
    model_.update(seen.at, seen.objects);
  }

  service_setup setup_;
  planner_options options_;
  known_roads_ptr roads_;
  object_tracker model_;
  std::optional<time_point> taken_in_;
  std::optional<plan_cycle> cycle_;
};

} // namespace

std::shared_ptr<service_function> make_onboard_planning(service_setup setup,
                                                        planner_options options,
                                                        known_roads_ptr roads) {
  return std::make_shared<onboard_planning>(
      std::move(setup), std::move(options), std::move(roads));
}

} // namespace sofof
