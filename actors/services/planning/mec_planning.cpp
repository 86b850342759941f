// Planning at a provider: from what vehicles and its own sensors tell it.
#include "actors/services/planning/mec_planning.hpp"

#include "actors/services/planning/agreed_word.hpp"
#include "actors/services/planning/others_around.hpp"
#include "actors/services/planning/plan_cycle.hpp"
#include "actors/services/planning/plan_request.hpp"
#include "actors/services/planning/suggestion_writer.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "planners/scene/ego_estimator.hpp"
#include "world/roads/route_finder.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace sofof::actors {

namespace {

class mec_planning final : public offloading::service_function {
public:
  mec_planning(planning_world_ptr world, offloading::provider_context provider,
               station_id vehicle, std::shared_ptr<edge_perception> perceived)
      : world_{std::move(world)}, provider_{std::move(provider)},
        station_{vehicle}, perceived_{perceived}, others_{
                                                      world_, provider_.id,
                                                      vehicle,
                                                      std::move(perceived)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    return plan(look(now, input));
  }

  offloading::begun_cycle begin(time_point now,
                                const messages::service_input& input) override {
    if (!has_begun_)
      return run(now, input);
    return [this, seen = look(now, input)] { return plan(seen); };
  }

private:
  // What a cycle takes from the world in its turn; `plan` reads nothing else.
  struct moment {
    time_point now;
    std::shared_ptr<const messages::its_pdu> word; // of the vehicle
    std::uint32_t session = 0;
    std::optional<messages::cam> own; // that the vehicle has told last
    bool others_are_known = false;
    point place; // where the provider is
  };

  moment look(time_point now, const messages::service_input& input) {
    auto word = others_.on_input(input.what, now);
    if (has_begun_)
      others_.look();
    return {now,
            std::move(word),
            input.session.counter,
            perceived_->told_by(station_),
            others_.are_known(),
            provider_.place()};
  }

  offloading::service_output plan(const moment& at) {
    if (at.word && at.word != heard_) {
      on_report(*at.word, at.now);
      heard_ = at.word;
    }
    if (!cycle_)
      return {};
    if (const auto& own = at.own)
      ego_->on_report({own->at, own->position, own->heading_rad, own->speed_mps,
                       own->accel_mps2, own->curvature_1pm});
    auto from = ego_->at(at.now);
    if (!from)
      return {};
    from->others.stop_at_m = stop_at_m_;
    from->others.agreed = agreed_.drive(*from, cycle_->way(), at.now);
    if (!has_begun_) // in the turn
      others_.look();
    const auto report =
        others_.plan(at.now, planners::made_possible(*from), *cycle_);
    ego_->follow(cycle_->plan());
    if (!has_begun_ && (report.emergency || !at.others_are_known))
      return {}; // until it would drive no worse than the vehicle itself
    has_begun_ = true;
    auto words = writer_.write(cycle_->plan(), at.session, at.place);
    if (words.empty())
      return {};
    return {std::move(words), messages::payload::of(report)};
  }

  // -- what the vehicle says ------------------------------------------------

  void on_report(const messages::its_pdu& message, time_point now) {
    static thread_local messages::etsi::mcm said; // room that is used again
    if (!messages::etsi::decode(message.view(), said)
        || said.header.station.value != station_)
      return;
    const auto word =
        messages::read_word(said, world_->where->ahead_by(message.ahead), now);
    if (!word || word->at < heard_at_ || protocol::is_of_future(word->at, now))
      return;
    heard_at_ = word->at;
    const auto ahead = place(word->way, now);
    if (!ahead) { // it goes where nobody here knows the way
      cycle_.reset();
      ego_.reset();
      return;
    }
    stop_at_m_ = ahead->to_m;
    if (!agreed_.on_report(*word) && word->plan)
      take_over(*word, ahead->from_m, now);
  }

  // Where on which route the vehicle's way ahead is.
  std::optional<world::route_stretch> place(std::span<const point> way,
                                            time_point now) {
    if (cycle_) {
      const auto own = ego_->at(now);
      const auto guess_m = own ? own->s_m : from_m_;
      if (const auto ahead = world::still_on(*cycle_->way(), guess_m, way)) {
        from_m_ = ahead->from_m;
        return ahead;
      }
    }
    const auto found = world::find_route(world_->streets->routes, way);
    if (!found)
      return std::nullopt;
    from_m_ = found->ahead.from_m;
    begin(found->way);
    return found->ahead;
  }

  // Of what was planned along another way that goes on which both share.
  void begin(const world::route_ptr& way) {
    const auto shared = cycle_ ? plan_along(*way, from_m_, cycle_->plan())
                               : world::trajectory{};
    cycle_.emplace(*world_, station_, stopwatch_of(provider_), true, way);
    ego_.emplace(way, from_m_);
    if (shared.is_sound())
      follow(shared);
  }

  void take_over(const messages::decoded_mcm& word, double from_m,
                 time_point now) {
    const messages::maneuver_frame frame{world_->where->frame, word.reference,
                                         word.at};
    world::trajectory plan;
    const auto fault = messages::to_trajectory(
        *word.plan, frame, *cycle_->way(), from_m, nullptr, plan);
    if (fault != messages::maneuver_fault::none
        || protocol::is_of_future(plan.start, now))
      return;
    ego_.emplace(cycle_->way(), from_m);
    const auto& first = plan.points.front(); // there it is, whatever CAMs said
    ego_->on_report({plan.start, first.at, first.heading_rad, first.speed_mps,
                     first.accel_mps2, first.curvature_1pm});
    follow(plan);
  }

  // The vehicle follows this plan.
  void follow(const world::trajectory& plan) {
    cycle_->take_over(plan);
    ego_->follow(plan);
  }

  planning_world_ptr world_;
  offloading::provider_context provider_;
  station_id station_; // of the vehicle
  std::shared_ptr<edge_perception> perceived_;
  others_around others_;
  std::shared_ptr<const messages::its_pdu> heard_; // last, ...
  time_point heard_at_;                            // and when it was said
  std::optional<plan_cycle> cycle_;
  std::optional<planners::ego_estimator> ego_; // whenever there is a cycle
  double from_m_ = 0;                          // of the last word
  double stop_at_m_ = 0; // the end of the vehicle's authority
  agreed_word agreed_{world_};
  suggestion_writer writer_{world_->where, provider_.station, station_};
  bool has_begun_ = false; // to suggest plans
};

} // namespace

std::shared_ptr<offloading::service_function>
make_mec_planning(planning_world_ptr world,
                  offloading::provider_context provider, station_id vehicle,
                  std::shared_ptr<edge_perception> perceived) {
  return std::make_shared<mec_planning>(std::move(world), std::move(provider),
                                        vehicle, std::move(perceived));
}

} // namespace sofof::actors
