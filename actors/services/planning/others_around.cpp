// What a provider's planner knows of the others round one vehicle, and by whom.
#include "actors/services/planning/others_around.hpp"

#include <utility>

namespace sofof::actors {

std::shared_ptr<const messages::its_pdu>
others_around::on_input(const messages::payload& what, time_point now) {
  const auto words = what.as<messages::its_pdus>();
  if (!words)
    return what.as<messages::its_pdu>();
  if (words->all.empty())
    return nullptr;
  if (words != heard_) {
    heard_ = words;
    auto told = words->all.size() > 1
                    ? read_scene_words(words->all[1], *world_->where, now)
                    : std::nullopt;
    if (told && told->from == vehicle_ && holds(*told, now))
      told_ = std::move(told);
    else
      told_.reset();
    if (auto found =
            world_->beside->find(chain_part::environment, provider_, vehicle_))
      beside_ = std::move(found);
  }
  return {words, &words->all.front()};
}

bool others_around::are_known() const {
  return heard_ ? told_ || beside_
                : perceived_->knows_surroundings_of(vehicle_);
}

void others_around::look() {
  if (told_)
    return;
  auto& source = beside_ ? *beside_ : static_cast<others_source&>(*perceived_);
  source.tracks(tracks_, vehicle_);
  source.drives(drives_, vehicle_);
}

planners::plan_report others_around::plan(time_point now,
                                          planners::planning_input from,
                                          plan_cycle& cycle) {
  if (told_) {
    auto scene = told_->scene;
    const auto& path = cycle.way()->path();
    move(scene, path.project(told_->position, from.s_m).s_m);
    scene.stop_at_m = from.others.stop_at_m;
    scene.agreed = std::move(from.others.agreed);
    from.others = std::move(scene);
    return cycle.run_in_scene(now, from);
  }
  const auto tracks = std::exchange(tracks_, {});
  const auto drives = std::exchange(drives_, {});
  return cycle.run(now, std::move(from), tracks, drives);
}

} // namespace sofof::actors
