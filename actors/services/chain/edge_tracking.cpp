// One vehicle's part of what a provider perceives.
#include "actors/services/chain/edge_tracking.hpp"

#include "actors/services/chain/track_words.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

class edge_tracking final : public offloading::service_function,
                            public others_source {
public:
  edge_tracking(planning_world_ptr world, offloading::provider_context provider,
                station_id vehicle, std::shared_ptr<edge_perception> perceived)
      : world_{std::move(world)}, provider_{std::move(provider)},
        vehicle_{vehicle}, perceived_{std::move(perceived)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto message = input.what.as<messages::its_pdu>();
    auto look = message ? read_objects(*message, *world_, now) : std::nullopt;
    if (!look || look->from != vehicle_)
      return {};
    look->ids.clear(); // they mean nothing in the next look, nor in CPMs
    perceived_->on_objects(
        *look, message->sender.value_or(sender_id{vehicle_.value()}));
    if (!has_begun_ && !perceived_->knows_surroundings_of(vehicle_))
      return {};
    has_begun_ = true;
    tracks(tracks_, vehicle_);
    const auto near =
        look->eye ? look->eye->at : provider_.position; // of the vehicle
    auto told = make_track_words({{.station = provider_.station,
                                   .at = now,
                                   .position = provider_.position},
                                  true},
                                 near, tracks_, vehicle_, *world_);
    if (told.octets.empty())
      return {};
    return messages::payload::of(std::move(told));
  }

  void tracks(std::vector<planners::track>& out, station_id station) override {
    perceived_->tracks(out, station);
  }
  void drives(std::vector<planners::told_drive>& out,
              station_id station) override {
    perceived_->drives(out, station);
  }

private:
  planning_world_ptr world_;
  offloading::provider_context provider_;
  station_id vehicle_;
  std::shared_ptr<edge_perception> perceived_;
  bool has_begun_ = false;              // to tell tracks
  std::vector<planners::track> tracks_; // room that is used again
};

} // namespace

std::shared_ptr<offloading::service_function>
make_edge_tracking(planning_world_ptr world,
                   offloading::provider_context provider, station_id vehicle,
                   std::shared_ptr<edge_perception> perceived) {
  const auto beside = world->beside;
  const auto id = provider.id;
  auto made = std::make_shared<edge_tracking>(
      std::move(world), std::move(provider), vehicle, std::move(perceived));
  beside->add(chain_part::tracking, id, vehicle, made);
  return made;
}

} // namespace sofof::actors
