// The scenes that a provider tells, in the vehicle that uses them.
#include "actors/services/chain/told_scenes.hpp"

#include "actors/services/chain/own_look.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "planners/judges/scene_judge.hpp"
#include "planners/scene/scene_interpreter.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

/// A scene counts from where the vehicle is, about: the provider knows it from
/// CAMs.
constexpr double same_place_m = 4;

/// A scene that a provider tells holds along the vehicle's own way.
class told_scenes final : public offloading::result_judge {
public:
  told_scenes(planning_world_ptr world, station_id vehicle)
      : world_{std::move(world)}, vehicle_{vehicle}, judge_{world_->car,
                                                            planners::noise_of(
                                                                world_->eyes)} {
  }

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point now) override {
    const auto request = latest.what.as<plan_request>();
    if (!request || !request->found.tracks || !prepare(request->way))
      return {};
    const auto message = result.as<messages::its_pdu>();
    auto told = message ? read_scene_words(*message, *world_->where, now)
                        : std::nullopt;
    if (!told || told->from != vehicle_ || !holds(*told, now))
      return {.useless = objection{"unreadable", 1, 0}};
    const auto& own = request->own;
    const auto moved_m = own.speed_mps * to_seconds(told->at - own.at);
    const auto from_m = request->from.s_m + moved_m;
    const auto place = way_->path().project(told->position, from_m);
    if (const auto off_m = std::abs(place.s_m - from_m); off_m > same_place_m)
      return {.useless = objection{"place", off_m, same_place_m}};
    move(told->scene, place.s_m);
    look(*request, told->at, place.s_m);
    const auto verdict =
        judge_.judge({.now = now,
                      .way = *way_,
                      .s_m = place.s_m,
                      .speed_mps = own.speed_mps,
                      .scene = own_,
                      .tracks = tracks_,
                      .look = own_look(*request, *world_),
                      .stop_at_m = request->stop_at_m(world_->car)},
                     world_->roads->houses(), told->scene);
    if (verdict.refused)
      return {{}, verdict.refused};
    margin_ = {"doubt_s", judge_.left_s()};
    return {messages::payload::of(known_scene{std::move(told->scene), {}}),
            {},
            {},
            {&margin_, 1}};
  }

private:
  bool prepare(const std::string& name) {
    if (way_ && way_->name() == name)
      return true;
    way_ = world_->streets->find(name);
    if (way_)
      scene_.emplace(world_->roads->way(way_), world_->look());
    return way_ != nullptr;
  }

  /// Makes out what the vehicle itself knows of a moment.
  void look(const plan_request& request, time_point at, double s_m) {
    const auto& known = request.found.tracks->all;
    tracks_.assign(known.begin(), known.end());
    for (auto& x : tracks_)
      if (x.at > at) { // tracks are not older than the scene that is asked for
        x.motion.mean.col(0) -= to_seconds(x.at - at) * x.motion.mean.col(1);
        x.at = at;
        x.seen = std::min(x.seen, at);
      }
    std::span<const planners::told_drive> drives;
    own_.agreed.reset();
    if (const auto* agreed_on = request.crossing.get()) {
      own_.agreed =
          planners::agreed(*agreed_on, at, request.agreeing(world_->car));
      drives = agreed_on->told;
    }
    scene_->describe(at,
                     {vehicle_, s_m, request.from.d_m, request.from.speed_mps},
                     tracks_, own_, drives);
  }

  planning_world_ptr world_;
  station_id vehicle_;
  planners::scene_judge judge_;
  margin margin_;
  world::route_ptr way_;
  std::optional<planners::scene_interpreter> scene_; // whenever there is a way
  // Room that is used again.
  std::vector<planners::track> tracks_;
  planners::driving_scene own_;
};

} // namespace

std::unique_ptr<offloading::result_judge>
make_scene_reader(planning_world_ptr world, station_id vehicle) {
  return std::make_unique<told_scenes>(std::move(world), vehicle);
}

} // namespace sofof::actors
