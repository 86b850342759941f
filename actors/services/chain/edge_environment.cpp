// The environment model of one vehicle at a provider.
#include "actors/services/chain/edge_environment.hpp"

#include "actors/services/chain/track_words.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/scene/ego_estimator.hpp"
#include "planners/scene/object_tracker.hpp"
#include "planners/scene/scene_interpreter.hpp"
#include "world/roads/route_finder.hpp"

#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

class edge_environment final : public offloading::service_function,
                               public others_source {
public:
  edge_environment(planning_world_ptr world,
                   offloading::provider_context provider, station_id vehicle,
                   std::shared_ptr<edge_perception> perceived)
      : world_{std::move(world)}, provider_{std::move(provider)},
        vehicle_{vehicle}, perceived_{std::move(perceived)},
        told_{planners::noise_of(world_->eyes)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    const auto words = input.what.as<messages::its_pdus>();
    if (!words || words->all.empty() || !on_word(words->all.front(), now)
        || !knows_tracks(*words, now))
      return {};
    if (const auto own = perceived_->told_by(vehicle_))
      ego_->on_report({own->at, own->position, own->heading_rad, own->speed_mps,
                       own->accel_mps2, own->curvature_1pm});
    const auto at = ego_->at(now);
    if (!at)
      return {};
    tracks(tracks_, vehicle_);
    drives(drives_, vehicle_);
    scene_->describe(now, {vehicle_, at->s_m, at->d_m, at->speed_mps}, tracks_,
                     found_, drives_);
    auto message = make_scene_words(
        found_, {vehicle_, at->s_m, way_->path().at(at->s_m).at, now, now},
        *world_->where);
    if (message.octets.empty())
      return {};
    return messages::payload::of(std::move(message));
  }

  void tracks(std::vector<planners::track>& out, station_id station) override {
    const std::lock_guard lock{mutex_};
    if (beside_)
      beside_->tracks(out, station);
    else
      out.assign(told_.tracks().begin(), told_.tracks().end());
  }
  void drives(std::vector<planners::told_drive>& out,
              station_id station) override {
    perceived_->drives(out, station);
  }

private:
  /// @returns whether it is known where the vehicle goes.
  bool on_word(const messages::its_pdu& message, time_point now) {
    if (!messages::etsi::decode(message.view(), word_)
        || word_.header.station.value != vehicle_)
      return false;
    const auto word =
        messages::read_word(word_, world_->where->ahead_by(message.ahead), now);
    if (!word || protocol::is_of_future(word->at, now))
      return false;
    if (way_ && ego_)
      if (const auto ahead = world::still_on(*way_, from_m_, word->way)) {
        from_m_ = ahead->from_m;
        return true;
      }
    const auto found = world::find_route(world_->streets->routes, word->way);
    if (!found)
      return false;
    way_ = found->way;
    from_m_ = found->ahead.from_m;
    ego_.emplace(way_, from_m_);
    scene_.emplace(world_->roads->way(way_), world_->look());
    return true;
  }

  /// @returns whether tracks are known: those that come with the word, or those
  /// that are made here.
  bool knows_tracks(const messages::its_pdus& words, time_point now) {
    if (words.all.size() == 1) {
      auto found =
          world_->beside->find(chain_part::tracking, provider_.id, vehicle_);
      const std::lock_guard lock{mutex_};
      if (found)
        beside_ = std::move(found);
      return beside_ != nullptr;
    }
    const auto told = read_objects(words.all[1], *world_, now);
    if (!told || told->from != vehicle_)
      return false;
    const std::lock_guard lock{mutex_};
    beside_.reset();
    told_.update(told->at, told->objects);
    return true;
  }

  planning_world_ptr world_;
  offloading::provider_context provider_;
  station_id vehicle_;
  std::shared_ptr<edge_perception> perceived_;
  std::mutex mutex_; // a planner asks for tracks
  planners::object_tracker told_;
  std::shared_ptr<others_source> beside_; // who has tracks here
  world::route_ptr way_;
  double from_m_ = 0;                          // of the last word
  std::optional<planners::ego_estimator> ego_; // whenever there is a way, ...
  std::optional<planners::scene_interpreter> scene_; // ... likewise
  // Room that is used again.
  messages::etsi::mcm word_;
  std::vector<planners::track> tracks_;
  std::vector<planners::told_drive> drives_;
  planners::driving_scene found_;
};

} // namespace

std::shared_ptr<offloading::service_function>
make_edge_environment(planning_world_ptr world,
                      offloading::provider_context provider, station_id vehicle,
                      std::shared_ptr<edge_perception> perceived) {
  const auto beside = world->beside;
  const auto id = provider.id;
  auto made = std::make_shared<edge_environment>(
      std::move(world), std::move(provider), vehicle, std::move(perceived));
  beside->add(chain_part::environment, id, vehicle, made);
  return made;
}

} // namespace sofof::actors
