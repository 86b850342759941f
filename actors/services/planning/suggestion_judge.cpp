// Judges what a provider suggests, by what the vehicle itself sees.
#include "actors/services/planning/suggestion_judge.hpp"

#include "actors/services/planning/onboard_planning.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/judges/plan_judge.hpp"

#include <utility>

namespace sofof::actors {

namespace {

class suggestion_judge final : public offloading::result_judge {
public:
  suggestion_judge(planning_world_ptr world,
                   offloading::vehicle_context vehicle)
      : world_{std::move(world)}, vehicle_{std::move(vehicle)},
        judge_{world_->car} {}

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point now) override {
    const auto request = latest.what.as<plan_request>();
    if (!request || !is_on(request->way))
      return {};
    const auto before = latest.in_use.as<world::trajectory>();
    world::trajectory plan;
    static thread_local messages::etsi::mcm said; // room that is used again
    const auto message = result.as<messages::its_pdu>();
    if (!message || !messages::etsi::decode(message->view(), said)
        || messages::read_suggestion(
               said, vehicle_.station, *way_, request->from.s_m,
               world_->where->ahead_by(message->ahead), now, before.get(), plan)
               != messages::maneuver_fault::none)
      return not_used(judge_.judge_unreadable());
    const auto& own = request->own;
    planners::judged_plan x{.way = *way_,
                            .plan = plan,
                            .in_use = before.get(),
                            .own = {own.at, own.position, own.heading_rad,
                                    own.speed_mps, own.accel_mps2,
                                    own.curvature_1pm},
                            .s_m = request->from.s_m,
                            .seen = request->seen,
                            .crossings_granted = world_->crossings_granted,
                            .now = now,
                            .fingerprint = messages::fingerprint_of_plan(said)};
    const auto alone =
        judge_.wants_own_plan(x) ? own_plan(latest, now) : nullptr;
    x.own_plan = alone.get();
    const auto verdict = judge_.judge(x);
    if (!verdict.usable)
      return not_used(verdict);
    return {messages::payload::of(std::move(plan)), {}, {}, judge_.margins()};
  }

private:
  /// @returns whether there is a route of that name, which is looked at now.
  bool is_on(const std::string& name) {
    if (!way_ || way_->name() != name)
      way_ = world_->streets->find(name);
    return way_ != nullptr;
  }

  std::shared_ptr<const world::trajectory>
  own_plan(const messages::service_input& latest, time_point now) {
    if (!own_)
      own_ = make_onboard_planning(world_, vehicle_);
    const auto made = own_->run(now, latest);
    auto plan = made.what.as<world::trajectory>();
    const auto about = made.about.as<planners::plan_report>();
    // One that is kept is the provider's.
    const auto is_own =
        about && about->origin == planners::plan_origin::planned;
    return plan && is_own ? plan : std::make_shared<const world::trajectory>();
  }

  static offloading::judged_result
  not_used(const planners::plan_verdict& verdict) {
    return {{}, verdict.refused, verdict.useless};
  }

  planning_world_ptr world_;
  offloading::vehicle_context vehicle_;
  world::route_ptr way_; // of the last request
  // To compare with, when needed.
  std::shared_ptr<offloading::service_function> own_;
  planners::plan_judge judge_;
};

} // namespace

std::unique_ptr<offloading::result_judge>
make_suggestion_judge(planning_world_ptr world,
                      offloading::vehicle_context vehicle) {
  return std::make_unique<suggestion_judge>(std::move(world),
                                            std::move(vehicle));
}

} // namespace sofof::actors
