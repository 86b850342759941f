// The tracks that a provider tells, in the vehicle that uses them.
#include "actors/services/chain/told_tracks.hpp"

#include "actors/services/chain/own_look.hpp"
#include "actors/services/chain/track_words.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "planners/judges/track_judge.hpp"
#include "planners/scene/object_tracker.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::actors {

namespace {

using namespace std::chrono_literals;

/// Bodies that were not told are kept for so long after that was the case.
constexpr duration kept_besides = 300ms;
/// What they are called: no body that is told has such a number.
constexpr std::uint32_t besides_from = 1U << 31U;

class told_tracks final : public offloading::result_judge {
public:
  told_tracks(planning_world_ptr world,
              std::shared_ptr<const planners::line_of_sight> houses)
      : world_{std::move(world)}, judge_{planners::noise_of(world_->eyes),
                                         std::move(houses)},
        model_{planners::noise_of(world_->eyes)} {}

  offloading::judged_result judge(const messages::payload& result,
                                  const messages::service_input& latest,
                                  time_point now) override {
    const auto message = result.as<messages::its_pdu>();
    const auto told =
        message ? read_objects(*message, *world_, now) : std::nullopt;
    if (!told)
      return {.useless = objection{"unreadable", 1, 0}};
    const auto request = latest.what.as<plan_request>();
    if (!request)
      return {};
    const auto verdict = judge_.judge(
        {now, told->at, told->objects, told->ids, own_look(*request, *world_)});
    if (verdict.refused || verdict.useless)
      return {{}, verdict.refused, verdict.useless};
    model_.update(told->at, told->objects);
    add_besides(*request);
    margin_ = {"doubt_s", judge_.left_s()};
    return {
        messages::payload::of(known_tracks{united()}), {}, {}, {&margin_, 1}};
  }

private:
  /// What the vehicle sees and is not told is kept apart: put together with a
  /// body that is told elsewhere it would be half way between.
  void add_besides(const plan_request& request) {
    const auto found = judge_.besides();
    if (!found.empty())
      besides_at_ = request.seen.at;
    if (besides_at_ && request.seen.at - *besides_at_ > kept_besides) {
      besides_at_.reset();
      besides_.reset();
    }
    if (!besides_at_)
      return;
    if (!besides_)
      besides_.emplace(planners::noise_of(world_->eyes));
    besides_->update(request.seen.at, found, request.own.position);
  }

  std::vector<planners::track> united() const {
    const auto told = model_.tracks();
    std::vector<planners::track> all{told.begin(), told.end()};
    if (besides_)
      for (auto x : besides_->tracks()) {
        x.id |= besides_from;
        all.push_back(x);
      }
    return all;
  }

  planning_world_ptr world_;
  planners::track_judge judge_;
  margin margin_;
  planners::object_tracker model_;
  std::optional<planners::object_tracker> besides_;
  std::optional<time_point> besides_at_; // when there was one of them last
};

} // namespace

std::unique_ptr<offloading::result_judge>
make_track_reader(planning_world_ptr world,
                  std::shared_ptr<const planners::line_of_sight> houses) {
  return std::make_unique<told_tracks>(std::move(world), std::move(houses));
}

} // namespace sofof::actors
