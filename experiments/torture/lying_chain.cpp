// A provider that lies about tracks or scenes.
#include "experiments/torture/lying_chain.hpp"

#include "actors/services/chain/track_words.hpp"
#include "actors/services/planning/planning_world.hpp"
#include "actors/services/planning/scene_words.hpp"
#include "experiments/torture/changed_service.hpp"
#include "messages/v2x/object_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

using namespace std::chrono_literals;

namespace {

constexpr double lied_about_m = 60; ///< Bodies within this of the vehicle.
constexpr double same_body_m = 3;
constexpr double to_left_m = 3, slower_by = 0.5;
constexpr double added_m = 15, added_lead_m = 12;
constexpr double farther_m = 12, farther_beside_m = 1.5, map_off_m = 8;
constexpr double a_little_on_m = 0.7, a_little_left_m = 0.45;
constexpr double nearer_m = 5, fast_mps = 50;
constexpr double far_m = 300, crowd_s = 150;
constexpr std::uint32_t crowd = 4;
constexpr std::uint32_t most_made_up = 5'000; ///< Messages number no more.
constexpr std::uint32_t made_up_id = 60'000;  ///< No tracker counts so far.

planners::track track_of(const world::perceived_object& x, std::uint32_t id,
                         time_point at) {
  const auto velocity = x.speed_mps * messages::unit_vector(x.heading_rad);
  planners::track made;
  made.id = id;
  made.at = made.seen = made.moved = at;
  made.motion.mean << x.centre.x_m, velocity.x_m, x.centre.y_m, velocity.y_m;
  made.heading_rad = x.heading_rad;
  made.accel_mps2 = x.accel_mps2;
  made.length_m = x.length_m;
  made.width_m = x.width_m;
  return made;
}

/// Leaves only bodies that were seen.
void hide(messages::object_list& told,
          std::span<const world::perceived_object> seen) {
  for (std::size_t k = told.objects.size(); k-- > 0;)
    if (std::ranges::none_of(seen, [&](const auto& x) {
          return distance_m(x.centre, told.objects[k].centre) < same_body_m;
        })) {
      told.objects.erase(told.objects.begin() + static_cast<std::ptrdiff_t>(k));
      told.ids.erase(told.ids.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

/// @param seen  By the vehicle, and from where: the middle of its front.
void change(messages::object_list& told, const messages::object_list& seen,
            chain_lie what) {
  const auto& from = *seen.eye;
  if (what == chain_lie::tracks_hidden)
    hide(told, seen.objects);
  const auto ahead = messages::unit_vector(from.heading_rad);
  const point left{-ahead.y_m, ahead.x_m};
  const auto is_near = [&](const world::perceived_object& x) {
    return distance_m(x.centre, from.at) < lied_about_m
           && dot(ahead, x.centre - from.at) > 0;
  };
  if (what == chain_lie::tracks_added) {
    told.ids.push_back(made_up_id);
    told.objects.push_back(
        {from.at + added_m * ahead, from.heading_rad, 0, 0,
         world::vehicle_params{}.front_m + world::vehicle_params{}.rear_m,
         world::vehicle_params{}.width_m});
  }
  for (std::size_t k = told.objects.size(); k-- > 0;) {
    auto& x = told.objects[k];
    if (!is_near(x))
      continue;
    if (what == chain_lie::tracks_shifted)
      x.centre = x.centre + to_left_m * left;
    else if (what == chain_lie::tracks_slowed)
      x.speed_mps *= slower_by;
    else if (what == chain_lie::tracks_new_ids)
      x.centre = x.centre + a_little_on_m * messages::unit_vector(x.heading_rad)
                 + a_little_left_m * left;
    else if (what == chain_lie::tracks_removed) {
      told.objects.erase(told.objects.begin() + static_cast<std::ptrdiff_t>(k));
      told.ids.erase(told.ids.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
}

/// Whoever leads or is beside is told to cross there, and to give way.
void give_way(planners::driving_scene& told) {
  constexpr auto at_once_s = 0.01, soon_s = 0.3;
  const auto cross = [&](double from_m, double to_m, std::uint32_t body) {
    planners::crossing_user x;
    x.from_m = from_m;
    x.to_m = to_m;
    x.enter_s = at_once_s;
    x.leave_s = soon_s;
    x.goes_first = false;
    x.body = body;
    told.crossings.push_back(x);
  };
  auto id = made_up_id;
  if (told.lead)
    cross(told.lead->rear_s_m, told.lead->rear_s_m + same_body_m, id++);
  for (const auto& x : told.beside)
    cross(x.from_m, x.to_m, id++);
  told.lead.reset();
  told.lead_told.clear();
  told.beside.clear();
}

void add_crowd(planners::driving_scene& told) {
  for (std::uint32_t k = 0; k < crowd; ++k) {
    planners::crossing_user x;
    x.from_m = far_m + k;
    x.to_m = x.from_m + same_body_m;
    x.enter_s = -1;
    x.leave_s = crowd_s;
    x.body = made_up_id + k;
    told.crossings.push_back(x);
  }
}

/// Arc lengths count from the vehicle's rear axle.
void change(planners::driving_scene& told, chain_lie what) {
  switch (what) {
    case chain_lie::scene_removed:
      told.lead.reset();
      told.lead_told.clear();
      told.crossings.clear();
      told.beside.clear();
      break;
    case chain_lie::scene_added:
      told.lead.emplace().rear_s_m =
          world::vehicle_params{}.front_m + added_lead_m;
      told.lead_told.clear();
      break;
    case chain_lie::scene_shifted:
      if (told.lead)
        told.lead->rear_s_m += farther_m;
      for (auto& x : told.lead_told)
        x.s_m += farther_m;
      for (auto& x : told.crossings) {
        x.from_m += farther_m;
        x.to_m += farther_m;
      }
      for (auto& x : told.beside) {
        const auto by_m =
            x.low_m + x.high_m > 0 ? farther_beside_m : -farther_beside_m;
        x.low_m += by_m;
        x.high_m += by_m;
      }
      break;
    case chain_lie::scene_map:
      actors::move(told, map_off_m);
      break;
    case chain_lie::scene_lead_fast:
      if (told.lead) {
        told.lead->rear_s_m -= nearer_m;
        told.lead->speed_mps = fast_mps;
        told.lead_told.clear();
      }
      break;
    case chain_lie::scene_gives_way:
      give_way(told);
      break;
    case chain_lie::scene_told_moment:
      if (told.lead)
        told.lead_told = {{told.lead->rear_s_m, 0}};
      break;
    case chain_lie::scene_beside_fast:
      for (auto& x : told.beside)
        x.speed_mps = fast_mps;
      break;
    case chain_lie::scene_far_crossings:
      add_crowd(told);
      break;
    default:
      break;
  }
  std::ranges::sort(told.crossings, {}, &planners::crossing_user::from_m);
}

/// An honest function whose results are changed on their way out.
class lying_part final : public offloading::service_function {
public:
  lying_part(std::shared_ptr<offloading::service_function> honest,
             actors::planning_world_ptr world,
             offloading::provider_context provider, chain_lie what,
             duration after, lies_told told)
      : honest_{std::move(honest)}, world_{std::move(world)},
        provider_{std::move(provider)}, what_{what}, after_{after},
        told_{std::move(told)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    auto out = honest_->run(now, input);
    const auto message = out.what.as<messages::its_pdu>();
    if (!message)
      return out;
    if (!began_)
      began_ = now;
    if (now - *began_ < after_)
      return out;
    const auto word = [&](bool is_lie) {
      return liar_of(what_) == "tracking" ? tracks(*message, input, now, is_lie)
                                          : scene(*message, now, is_lie);
    };
    auto told = word(true);
    if (told.octets.empty())
      return out;
    if (told_ && told.octets != word(false).octets)
      ++*told_;
    out.what = messages::payload::of(std::move(told));
    return out;
  }

private:
  messages::its_pdu tracks(const messages::its_pdu& honest,
                           const messages::service_input& input, time_point now,
                           bool is_lie) {
    const auto look = input.what.as<messages::its_pdu>();
    const auto seen =
        look ? actors::read_objects(*look, *world_, now) : std::nullopt;
    auto told = actors::read_objects(honest, *world_, now);
    if (!told || !seen || !seen->eye)
      return {};
    if (is_lie)
      change(*told, *seen, what_);
    if (is_lie && what_ == chain_lie::tracks_new_ids)
      for (auto& id : told->ids)
        id = made_up_id + ++renumbered_ % most_made_up;
    std::vector<planners::track> changed;
    for (std::size_t k = 0; k < told->objects.size(); ++k)
      changed.push_back(track_of(told->objects[k], told->ids[k], told->at));
    messages::cam own;
    own.station = provider_.station;
    own.at = now;
    own.position = provider_.position;
    return actors::make_track_words({own, true}, seen->eye->at, changed, 0,
                                    *world_);
  }

  messages::its_pdu scene(const messages::its_pdu& honest, time_point now,
                          bool is_lie) const {
    auto told = actors::read_scene_words(honest, *world_->where, now);
    if (!told)
      return {};
    if (is_lie)
      change(told->scene, what_);
    return actors::make_scene_words(
        told->scene, {told->from, 0, told->position, told->at, told->seen},
        *world_->where);
  }

  std::shared_ptr<offloading::service_function> honest_;
  actors::planning_world_ptr world_;
  offloading::provider_context provider_;
  chain_lie what_;
  duration after_;
  lies_told told_;
  std::optional<time_point> began_;
  std::uint32_t renumbered_ = 0;
};

class lying_part_at_provider final : public real_at_provider {
public:
  lying_part_at_provider(std::shared_ptr<offloading::provider_service> honest,
                         actors::planning_world_ptr world,
                         offloading::provider_context provider, chain_lie what,
                         duration after, lies_told told)
      : real_at_provider{std::move(honest)}, world_{std::move(world)},
        provider_{std::move(provider)}, what_{what}, after_{after},
        told_{std::move(told)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return std::make_shared<lying_part>(
        real_at_provider::make_function(vehicle), world_, provider_, what_,
        after_, told_);
  }

private:
  actors::planning_world_ptr world_;
  offloading::provider_context provider_;
  chain_lie what_;
  duration after_;
  lies_told told_;
};

} // namespace

std::optional<chain_lie> chain_lie_of(std::string_view name) {
  const auto found = std::ranges::find(chain_lie_names, name);
  if (found == chain_lie_names.end())
    return std::nullopt;
  return static_cast<chain_lie>(found - chain_lie_names.begin());
}

std::string_view liar_of(chain_lie what) {
  return what < chain_lie::scene_removed ? "tracking" : "environment_model";
}

actors::service_type_ptr lying_chain(actors::service_type_ptr honest,
                                     chain_lie what, duration after,
                                     lies_told told) {
  return std::make_shared<changed_service>(
      std::move(honest),
      [=](offloading::service& service, const actors::service_world& world) {
        const auto shared = std::make_shared<const actors::planning_world>(
            world.streets, world.where, world.car, world.crossings_granted,
            world.eyes);
        service.at_provider =
            [=, real = service.at_provider](const auto& provider) {
              return std::make_shared<lying_part_at_provider>(
                  real(provider), shared, provider, what, after, told);
            };
      });
}

} // namespace sofof::experiments::torture
