// Trajectory planning as a service: the vehicle is its client; the planner at
// a provider may plan farther and more thoroughly than the vehicle's own.
#include "actors/offloading/service_type.hpp"
#include "actors/services/planning/mec_planning.hpp"
#include "actors/services/planning/onboard_planning.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/judges/plan_judge.hpp"
#include "policies/algorithms/forecast/continuity.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

namespace sofof {

namespace {

using namespace std::chrono_literals;

/// Where the vehicle may go: along its route, from its rear axle on, up to
/// where its front has to wait.
std::vector<point> authority(const route& way, double s_m,
                             std::optional<double> stop_at_m) {
  constexpr double least_m = 2; // less has no direction
  const auto told_m =
      std::clamp(stop_at_m.value_or(s_m + protocol::authority_m) - s_m, least_m,
                 protocol::authority_m);
  return way.waypoints(s_m, told_m, protocol::authority_spacing_m);
}

/// Makes a trajectory along the vehicle's way of what a provider suggests, and
/// judges it by what the vehicle itself sees.
class suggestion_judge final : public result_judge {
public:
  /// @param make_own  The vehicle's own planner, to compare with.
  suggestion_judge(service_setup setup,
                   std::function<std::shared_ptr<service_function>()> make_own)
      : setup_{std::move(setup)}, make_own_{std::move(make_own)},
        judge_{setup_.car} {}

  judged_result judge(const payload& result, const service_input& latest,
                      time_point now) override {
    const auto request = latest.what.as<plan_request>();
    const auto way = request ? setup_.world->find(request->way) : nullptr;
    if (!way)
      return {};
    const auto before = latest.in_use.as<trajectory>();
    trajectory plan;
    const auto message = result.as<its_pdu>();
    if (!message || !etsi::decode(message->view(), word_)
        || read_suggestion(word_, setup_.station, *way, request->from.s_m,
                           setup_.where->ahead_by(message->ahead), now,
                           before.get(), plan)
               != maneuver_fault::none)
      return not_used(judge_.judge_unreadable());
    const auto& own = request->own;
    judged_plan x{.way = *way,
                  .plan = plan,
                  .in_use = before.get(),
                  .own = {own.at, own.position, own.heading_rad, own.speed_mps,
                          own.accel_mps2, own.curvature_1pm},
                  .s_m = request->from.s_m,
                  .seen = request->seen,
                  .crossings_granted = setup_.crossings_granted,
                  .now = now,
                  .fingerprint = fingerprint_of_plan(word_)};
    const auto alone =
        judge_.wants_own_plan(x) ? own_plan(latest, now) : nullptr;
    x.own_plan = alone.get();
    const auto verdict = judge_.judge(x);
    if (!verdict.usable)
      return not_used(verdict);
    return {payload::of(std::move(plan)), {}, {}, judge_.margins()};
  }

private:
  std::shared_ptr<const trajectory> own_plan(const service_input& latest,
                                             time_point now) {
    if (!own_)
      own_ = make_own_();
    const auto made = own_->run(now, latest);
    auto plan = made.what.as<trajectory>();
    const auto about = made.about.as<plan_report>();
    // One that is kept is the provider's.
    const auto is_own = about && about->origin == plan_origin::planned;
    return plan && is_own ? plan : std::make_shared<const trajectory>();
  }

  static judged_result not_used(const plan_verdict& verdict) {
    return {{}, verdict.refused, verdict.useless};
  }

  service_setup setup_;
  std::function<std::shared_ptr<service_function>()> make_own_;
  std::shared_ptr<service_function> own_; // from when it is needed on
  plan_judge judge_;
  etsi::mcm word_; // room that is used again
};

etsi::termination_status status_of(end_reason why) {
  using enum etsi::termination_status;
  switch (why) {
    case end_reason::left_area:
    case end_reason::handed_over:
    case end_reason::released:
    case end_reason::shutdown:
      return regular_end;
    case end_reason::cam_timeout:
    case end_reason::no_data:
      return abort_by_timeout;
    case end_reason::qos_latency:
    case end_reason::qos_gap:
      return abort_by_constraint_violation;
    case end_reason::refused:
    case end_reason::revoked:
    case end_reason::implausible:
      return abort_by_reject;
    case end_reason::peer_lost:
      break;
  }
  return reason_unknown;
}

maneuver_name name_of_maneuver(const session_id& running) {
  return {static_cast<std::uint16_t>(running.counter), 0};
}

class trajectory_planning final : public service_type {
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
    service_type::fields(s);
    s.table("planner", [this](settings& t) { planner_.fields(t); });
  }

  std::shared_ptr<service_function>
  make_function(const service_setup& setup) const override {
    auto roads = this->roads(setup.world->map);
    if (!setup.remote)
      return make_onboard_planning(setup, planner_, std::move(roads));
    return make_mec_planning(
        setup, planner_, std::move(roads),
        std::dynamic_pointer_cast<edge_perception>(setup.site));
  }

  std::shared_ptr<provider_context>
  make_site(const service_setup& setup) const override {
    return std::make_shared<edge_perception>(setup.clock,
                                             setup.world->map.buildings());
  }

  client_actor spawn_client(caf::actor_system&, const service_setup&,
                            const vehicle_actor& vehicle) const override {
    return vehicle;
  }

  /// An MCM: where the vehicle may go, and the plan in use for who takes over,
  /// or that it follows what was suggested.
  service_input on_air(const service_setup& setup, service_input input,
                       bool takes_over) const override {
    const auto request = input.what.as<plan_request>();
    const auto way = request ? setup.world->find(request->way) : nullptr;
    if (!way)
      return {};
    const auto ahead =
        authority(*way, request->from.s_m, request->seen.stop_at_m);
    mcm_uplink word{request->own, ahead, nullptr, {}};
    const auto plan = takes_over ? input.in_use.as<trajectory>() : nullptr;
    word.plan = plan.get();
    if (!takes_over)
      word.answer.emplace(name_of_maneuver(input.running),
                          etsi::maneuver_response::accept);
    auto message = encoded(make_word(word, setup.car, *setup.where));
    if (message.octets.empty())
      return {};
    input.what = payload::of(std::move(message));
    input.in_use = {};
    return input;
  }

  std::unique_ptr<result_judge>
  make_judge(const service_setup& setup) const override {
    return std::make_unique<suggestion_judge>(
        setup, [this, setup] { return make_function(setup); });
  }

  bool continues(const payload& in_use, const payload& offered,
                 time_point now) const override {
    const auto one = in_use.as<trajectory>();
    const auto other = offered.as<trajectory>();
    if (!one || !other || one->empty() || other->empty())
      return false;
    constexpr duration step = std::chrono::milliseconds{100};
    constexpr std::size_t count = 6; // 0.5 s
    std::array<point, count> here, there;
    for (std::size_t k = 0; k < count; ++k) {
      const auto t = now + k * step;
      here[k] = one->at(t).at;
      there[k] = other->at(t).at;
    }
    return sofof::continues(here, there, step);
  }

  payload termination_message(const service_setup& setup,
                              const service_end& end, time_point now,
                              const cam* own) const override {
    const auto name = name_of_maneuver(end.running);
    if (setup.remote)
      return payload::of(encoded(
          make_termination({setup.provider.station, setup.provider.position,
                            end.running.station, name},
                           now, status_of(end.reason), *setup.where)));
    if (!own)
      return {};
    mcm_uplink word{*own, {}, nullptr, {}};
    word.answer.emplace(name, etsi::maneuver_response::reject);
    return payload::of(encoded(make_word(word, setup.car, *setup.where)));
  }

private:
  // Found once for all functions, which vehicles make in their own threads.
  known_roads_ptr roads(const road_map& map) const {
    const std::lock_guard lock{mutex_};
    if (!roads_)
      roads_ = std::make_shared<known_roads>(map, planner_.style);
    return roads_;
  }

  planner_options planner_;
  mutable std::mutex mutex_;
  mutable known_roads_ptr roads_;
};

} // namespace

service_type_ptr make_trajectory_planning() {
  return std::make_shared<trajectory_planning>();
}

} // namespace sofof
