// Trajectory planning in a vehicle and at a provider: what each has of it.
#include "actors/services/planning/planning_sides.hpp"

#include "actors/services/planning/drive_words.hpp"
#include "actors/services/planning/mec_planning.hpp"
#include "actors/services/planning/onboard_planning.hpp"
#include "actors/services/planning/perceived_at.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/scene_look.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "actors/services/planning/session_maneuver.hpp"
#include "actors/services/planning/suggestion_judge.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "policies/algorithms/forecast/continuity.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

class planning_in_vehicle final : public offloading::vehicle_service {
public:
  planning_in_vehicle(planning_world_ptr world,
                      offloading::vehicle_context vehicle)
      : world_{std::move(world)}, vehicle_{std::move(vehicle)} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return make_onboard_planning(world_, vehicle_);
  }

  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return make_suggestion_judge(world_, vehicle_);
  }

  /// An MCM: where the vehicle may go, and the plan in use for who takes over,
  /// or that it follows what was suggested; "pending" means, within the drive
  /// that was agreed at a crossing, which it has then.
  messages::service_input encode_input(messages::service_input input,
                                       bool takes_over) const override {
    const auto request = input.what.as<plan_request>();
    const auto way = request ? world_->streets->find(request->way) : nullptr;
    if (!way)
      return {};
    const auto ahead =
        authority(*way, request->from.s_m, request->stop_at_m(world_->car));
    messages::mcm_uplink word{request->own, ahead, nullptr, {}};
    const auto plan =
        takes_over ? input.in_use.as<world::trajectory>() : nullptr;
    word.plan = plan.get();
    const auto agreed =
        takes_over || !request->crossing
            ? world::trajectory{}
            : told_rest(request->crossing->drive, request->own.at);
    if (!agreed.empty())
      word.plan = &agreed;
    if (!takes_over)
      word.answer.emplace(name_of_maneuver(input.session),
                          agreed.empty()
                              ? messages::etsi::maneuver_response::accept
                              : messages::etsi::maneuver_response::pending);
    auto message = messages::encoded(
        messages::make_word(word, world_->car, *world_->where));
    if (message.octets.empty())
      return {};
    input.in_use = {};
    input.what =
        request->found.scene
            ? with_scene(std::move(message), *way, *request, input.session)
            : messages::payload::of(std::move(message));
    if (input.what.empty())
      return {};
    return input;
  }

  /// Where both plans lead in the next 0.5 s.
  bool continues(const messages::payload& in_use,
                 const messages::payload& offered,
                 time_point now) const override {
    const auto one = in_use.as<world::trajectory>();
    const auto other = offered.as<world::trajectory>();
    if (!one || !other || one->empty() || other->empty())
      return false;
    constexpr duration step = std::chrono::milliseconds{100};
    constexpr std::size_t count = 6;
    std::array<point, count> here, there;
    for (std::size_t k = 0; k < count; ++k) {
      const auto t = now + k * step;
      here[k] = one->at(t).at;
      there[k] = other->at(t).at;
    }
    return policies::continues(here, there, step);
  }

  bool looks_at_scenes() const override { return true; }

  /// At what the vehicle detects; in a chain at the scene as well.
  std::optional<offloading::safe_response>
  look_at_scene(const messages::service_input& latest) const override {
    return look_at_all(latest, *world_);
  }

  messages::payload
  termination_message(const messages::service_end& end, time_point,
                      const messages::cam& own) const override {
    messages::mcm_uplink word{own, {}, nullptr, {}};
    word.answer.emplace(name_of_maneuver(end.session),
                        messages::etsi::maneuver_response::reject);
    return messages::payload::of(messages::encoded(
        messages::make_word(word, world_->car, *world_->where)));
  }

private:
  /// In a chain: the scene goes along, unless it was found at the same
  /// provider.
  messages::payload with_scene(messages::its_pdu word, const world::route& way,
                               const plan_request& request,
                               const messages::session_id& session) const {
    messages::its_pdus words{{std::move(word)}};
    if (request.found.scene_by != session.provider) {
      const auto& scene = request.found.scene->scene;
      const auto s_m = request.from.s_m;
      words.all.push_back(make_scene_words(
          scene,
          {vehicle_.station, s_m, way.path().at(s_m).at, scene.at, scene.at},
          *world_->where));
      if (words.all.back().octets.empty())
        return {};
    }
    return messages::payload::of(std::move(words));
  }

  planning_world_ptr world_;
  offloading::vehicle_context vehicle_;
};

class planning_at_provider final : public listening_service {
public:
  planning_at_provider(planning_world_ptr world,
                       offloading::provider_context provider)
      : world_{std::move(world)}, provider_{std::move(provider)},
        perceived_{perceived_at(*world_, provider_)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return make_mec_planning(world_, provider_, vehicle, perceived_);
  }

  messages::payload termination_message(const messages::service_end& end,
                                        time_point now) override {
    const messages::suggestion what{provider_.station, provider_.place(),
                                    end.session.station,
                                    name_of_maneuver(end.session)};
    return messages::payload::of(messages::encoded(messages::make_termination(
        what, now, status_of(end.reason), *world_->where)));
  }

  std::string_view objection(std::span<const point> route) const override {
    return objection_to(route, *world_->streets);
  }

  broadcast_listener* listener() override { return perceived_.get(); }

private:
  planning_world_ptr world_;
  offloading::provider_context provider_;
  std::shared_ptr<edge_perception> perceived_;
};

} // namespace

std::shared_ptr<offloading::vehicle_service>
make_planning_in_vehicle(planning_world_ptr world,
                         offloading::vehicle_context vehicle) {
  return std::make_shared<planning_in_vehicle>(std::move(world),
                                               std::move(vehicle));
}

std::shared_ptr<offloading::provider_service>
make_planning_at_provider(planning_world_ptr world,
                          offloading::provider_context provider) {
  return std::make_shared<planning_at_provider>(std::move(world),
                                                std::move(provider));
}

} // namespace sofof::actors
