// Tracking in a vehicle and at a provider: what each has of it.
#include "actors/services/chain/tracking_sides.hpp"

#include "actors/services/chain/edge_tracking.hpp"
#include "actors/services/chain/told_tracks.hpp"
#include "actors/services/chain/track_words.hpp"
#include "actors/services/planning/perceived_at.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/scene_look.hpp"
#include "base/protocol.hpp"
#include "planners/scene/line_of_sight.hpp"
#include "planners/scene/object_tracker.hpp"

#include <optional>
#include <span>
#include <utility>

namespace sofof::actors {

namespace {

messages::payload copied(std::span<const planners::track> tracks) {
  return messages::payload::of(known_tracks{{tracks.begin(), tracks.end()}});
}

// -- in the vehicle -----------------------------------------------------------

class onboard_tracking final : public offloading::service_function {
public:
  explicit onboard_tracking(const planning_world& world)
      : model_{planners::noise_of(world.eyes)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto request = input.what.as<plan_request>();
    if (!request)
      return {};
    take_in(now, *request);
    return copied(model_.tracks());
  }

  void observe(time_point now, const messages::service_input& input) override {
    if (const auto request = input.what.as<plan_request>())
      take_in(now, *request);
  }

private:
  // Every sight counts once.
  void take_in(time_point now, const plan_request& request) {
    const auto& seen = request.seen;
    if (seen.at == taken_in_ || protocol::is_of_future(seen.at, now))
      return;
    taken_in_ = seen.at;
    model_.update(seen.at, seen.objects, request.own.position);
  }

  planners::object_tracker model_;
  std::optional<time_point> taken_in_;
};

class tracking_in_vehicle final : public offloading::vehicle_service {
public:
  tracking_in_vehicle(planning_world_ptr world,
                      std::shared_ptr<const planners::line_of_sight> houses)
      : world_{std::move(world)}, houses_{std::move(houses)} {}

  std::shared_ptr<offloading::service_function> make_function() const override {
    return std::make_shared<onboard_tracking>(*world_);
  }

  /// A CPM of all that was seen in one look.
  messages::service_input encode_input(messages::service_input input,
                                       bool) const override {
    const auto request = input.what.as<plan_request>();
    if (!request)
      return {};
    auto message = make_look_words(request->own, request->seen, *world_);
    if (message.octets.empty())
      return {};
    input.what = messages::payload::of(std::move(message));
    input.in_use = {};
    return input;
  }

  std::unique_ptr<offloading::result_judge> make_judge() const override {
    return make_track_reader(world_, houses_);
  }

  bool looks_at_scenes() const override { return true; }

  /// For the whole chain: nobody knows sooner what was seen.
  std::optional<offloading::safe_response>
  look_at_scene(const messages::service_input& latest) const override {
    return look_at(latest, *world_);
  }

private:
  planning_world_ptr world_;
  std::shared_ptr<const planners::line_of_sight> houses_;
};

// -- at a provider ------------------------------------------------------------

class tracking_at_provider final : public listening_service {
public:
  tracking_at_provider(planning_world_ptr world,
                       offloading::provider_context provider)
      : world_{std::move(world)}, provider_{std::move(provider)},
        perceived_{perceived_at(*world_, provider_)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return make_edge_tracking(world_, provider_, vehicle, perceived_);
  }

  broadcast_listener* listener() override { return perceived_.get(); }

private:
  planning_world_ptr world_;
  offloading::provider_context provider_;
  std::shared_ptr<edge_perception> perceived_;
};

} // namespace

std::shared_ptr<offloading::vehicle_service> make_tracking_in_vehicle(
    planning_world_ptr world,
    std::shared_ptr<const planners::line_of_sight> houses) {
  return std::make_shared<tracking_in_vehicle>(std::move(world),
                                               std::move(houses));
}

std::shared_ptr<offloading::provider_service>
make_tracking_at_provider(planning_world_ptr world,
                          offloading::provider_context provider) {
  return std::make_shared<tracking_at_provider>(std::move(world),
                                                std::move(provider));
}

} // namespace sofof::actors
