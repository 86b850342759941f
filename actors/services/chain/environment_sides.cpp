// The environment model in a vehicle and at a provider: what each has of it.
#include "actors/services/chain/environment_sides.hpp"

#include "actors/services/chain/edge_environment.hpp"
#include "actors/services/chain/told_scenes.hpp"
#include "actors/services/chain/track_words.hpp"
#include "actors/services/planning/drive_words.hpp"
#include "actors/services/planning/perceived_at.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/planning_sides.hpp"
#include "messages/v2x/encoded.hpp"
#include "planners/scene/scene_interpreter.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

// -- in the vehicle -----------------------------------------------------------

class onboard_environment final : public offloading::service_function {
public:
  onboard_environment(planning_world_ptr world, station_id vehicle)
      : world_{std::move(world)}, vehicle_{vehicle} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request || !request->found.tracks || !prepare(request->way))
      return {};
    const auto& from = request->from;
    known_scene found{{}, request->found.tracks};
    std::span<const planners::told_drive> told;
    if (const auto* agreed_on = request->crossing.get()) {
      found.scene.agreed =
          planners::agreed(*agreed_on, now, request->agreeing(world_->car));
      told = agreed_on->told;
    }
    scene_->describe(now, {vehicle_, from.s_m, from.d_m, from.speed_mps},
                     found.made_of->all, found.scene, told);
    return messages::payload::of(std::move(found));
  }

private:
  bool prepare(const std::string& name) {
    if (scene_ && name == way_)
      return true;
    const auto way = world_->streets->find(name);
    if (!way)
      return false;
    scene_.emplace(world_->roads->way(way), world_->look());
    way_ = name;
    return true;
  }

  planning_world_ptr world_;
  station_id vehicle_;
  std::optional<planners::scene_interpreter> scene_;
  std::string way_; // that it looks along
};

class environment_in_vehicle final : public offloading::vehicle_service {
public:
  environment_in_vehicle(planning_world_ptr world,
                         offloading::vehicle_context vehicle)
      : world_{std::move(world)}, vehicle_{std::move(vehicle)} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<onboard_environment>(world_, vehicle_.station);
  }

  /// An MCM: where the vehicle may go; and a CPM of its tracks, unless they
  /// were made at the same provider.
  messages::service_input encode_input(messages::service_input input,
                                       bool) const override {
    const auto request = input.what.as<plan_request>();
    const auto way = request ? world_->streets->find(request->way) : nullptr;
    if (!way || !request->found.tracks)
      return {};
    const auto ahead =
        authority(*way, request->from.s_m, request->stop_at_m(world_->car));
    messages::its_pdus words;
    words.all.push_back(messages::encoded(messages::make_word(
        {request->own, ahead, nullptr, {}}, world_->car, *world_->where)));
    if (request->found.tracks_by != input.session.provider)
      words.all.push_back(make_track_words(
          {request->own}, request->own.position, request->found.tracks->all,
          vehicle_.station, *world_));
    for (const auto& word : words.all)
      if (word.octets.empty())
        return {};
    input.what = messages::payload::of(std::move(words));
    input.in_use = {};
    return input;
  }

  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return make_scene_reader(world_, vehicle_.station);
  }

private:
  planning_world_ptr world_;
  offloading::vehicle_context vehicle_;
};

// -- at a provider ------------------------------------------------------------

class environment_at_provider final : public listening_service {
public:
  environment_at_provider(planning_world_ptr world,
                          offloading::provider_context provider)
      : world_{std::move(world)}, provider_{std::move(provider)},
        perceived_{perceived_at(*world_, provider_)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return make_edge_environment(world_, provider_, vehicle, perceived_);
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
make_environment_in_vehicle(planning_world_ptr world,
                            offloading::vehicle_context vehicle) {
  return std::make_shared<environment_in_vehicle>(std::move(world),
                                                  std::move(vehicle));
}

std::shared_ptr<offloading::provider_service>
make_environment_at_provider(planning_world_ptr world,
                             offloading::provider_context provider) {
  return std::make_shared<environment_at_provider>(std::move(world),
                                                   std::move(provider));
}

} // namespace sofof::actors
