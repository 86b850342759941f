// A provider that lies about plans or crossings.
#include "experiments/torture/lying_planning.hpp"

#include "experiments/torture/changed_service.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/mcm/mcm_content.hpp"
#include "world/roads/route_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

using namespace std::chrono_literals;

namespace {

/// What the lying functions of one provider know of each other.
struct liars {
  lie what = lie::jump;
  duration after = 8s; ///< The first results are honest.
  std::mutex mutex;
  std::map<station_id, world::trajectory> plans; ///< Honest ones, the newest.
};

/// An honest function whose results are changed on their way out.
class lying_function final : public offloading::service_function {
public:
  lying_function(std::shared_ptr<offloading::service_function> honest,
                 actors::service_world world,
                 offloading::provider_context provider, station_id vehicle,
                 std::shared_ptr<liars> all)
      : honest_{std::move(honest)}, world_{std::move(world)},
        provider_{std::move(provider)}, station_{vehicle}, all_{std::move(
                                                               all)} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    auto out = honest_->run(now, input);
    hear(input, now);
    const auto message = out.what.as<messages::its_pdu>();
    if (!message || !way_ || !messages::etsi::decode(message->view(), word_))
      return out;
    world::trajectory plan;
    const auto guess_m = said_.empty() ? from_m_ : said_.at(now).s_m;
    if (messages::read_suggestion(word_, station_, *way_, guess_m,
                                  *world_.where, now, nullptr, plan)
        != messages::maneuver_fault::none)
      return out;
    remember(plan);
    if (!began_)
      began_ = now;
    if (now - *began_ < all_->after) {
      said_ = plan;
      return out;
    }
    const auto told = instead_of(plan, now);
    said_ = told;
    const messages::suggestion what{
        provider_.station,
        provider_.position,
        station_,
        {static_cast<std::uint16_t>(input.session.counter), ++update_}};
    if (!messages::make_suggestion(what, told, *world_.where, room_, word_))
      return {};
    return {messages::payload::of(messages::encoded(word_)), out.about};
  }

private:
  void hear(const messages::service_input& input, time_point now) {
    auto message = input.what.as<messages::its_pdu>();
    // In a chain the vehicle's word is the first of several messages.
    if (const auto words = input.what.as<messages::its_pdus>();
        words && !words->all.empty())
      message = {words, &words->all.front()};
    messages::etsi::mcm mcm;
    if (!message || !messages::etsi::decode(message->view(), mcm))
      return;
    const auto word = messages::read_word(mcm, *world_.where, now);
    if (!word)
      return;
    if (const auto found =
            world::find_route(world_.streets->routes, word->way)) {
      way_ = found->way;
      from_m_ = found->ahead.from_m;
    }
  }

  void remember(const world::trajectory& plan) {
    const std::lock_guard lock{all_->mutex};
    all_->plans[station_] = plan;
    past_.push_back(plan);
    if (past_.size() > 100) // 5 s
      past_.pop_front();
  }

  // From a point on, by an acceleration, to one side.
  // @param accel   Of time from now on, m/s².
  // @param aside_m Of the same: how far to the left of where it is.
  template <class Accel, class Aside>
  world::trajectory made(const world::trajectory_point& from, time_point now,
                         Accel accel, Aside aside_m) const {
    constexpr double step_s = 0.1;
    constexpr int steps = 60;
    const auto& path = way_->path();
    const auto begin = path.frame(from.s_m);
    const auto d0_m = cross(begin.tangent, from.at - begin.at);
    world::trajectory out;
    out.start = now;
    auto s_m = from.s_m, v = from.speed_mps;
    for (int k = 0; k <= steps; ++k) {
      const auto t = k * step_s;
      const auto lane = path.frame(s_m);
      const point left{-lane.tangent.y_m, lane.tangent.x_m};
      const auto d_m = d0_m + aside_m(t);
      const auto slope = (aside_m(t + 0.01) - aside_m(t)) / 0.01;
      const auto a = v > 0 || accel(t) > 0 ? accel(t) : 0.0;
      out.points.push_back(
          {t, s_m, lane.at + d_m * left,
           lane.heading_rad + (v > 1 ? std::atan(slope / v) : 0.0),
           lane.curvature_1pm, v, a});
      const auto next = std::max(0.0, v + a * step_s);
      s_m += step_s * (v + next) / 2;
      v = next;
    }
    return out;
  }

  world::trajectory instead_of(const world::trajectory& honest,
                               time_point now) {
    const auto from =
        !said_.empty() && now < said_.end() ? said_.at(now) : honest.at(now);
    const auto lied_s = to_seconds(now - *began_ - all_->after);
    const auto straight = [](double) { return 0.0; };
    const auto by = [](double a) { return [a](double) { return a; }; };
    switch (all_->what) {
      case lie::jump: {
        auto plan = honest;
        for (auto& p : plan.points)
          p.at =
              p.at
              + 3.0 * point{-std::sin(p.heading_rad), std::cos(p.heading_rad)};
        return plan;
      }
      case lie::g100: {
        auto start = from;
        start.speed_mps = 160;
        return made(start, now, by(0), straight);
      }
      case lie::stale:
        if (first_.empty())
          first_ = honest;
        return first_;
      case lie::ram:
        return made(from, now, by(3.4), straight);
      case lie::mix:
        return made(from, now, by(station_.value() % 2 == 0 ? -6 : 3.4),
                    straight);
      case lie::offroad:
        return made(from, now, by(0), [](double t) { return -0.8 * t; });
      case lie::oncoming:
        return made(from, now, by(0),
                    [](double t) { return std::min(3.5, 1.0 * t); });
      case lie::brake:
        return made(from, now, by(-9), straight);
      case lie::stands:
        return made(from, now, by(stop_on_crossing(from)), straight);
      case lie::drifts:
        return moved_right(honest, 0.2 * lied_s);
      case lie::swaps: {
        const std::lock_guard lock{all_->mutex};
        auto other = all_->plans.upper_bound(station_);
        if (other == all_->plans.end())
          other = all_->plans.begin();
        auto plan = other->second;
        plan.start = honest.start;
        return plan;
      }
      case lie::oscillates:
        return made(from, now, by(++turns_ % 2 == 0 ? 3.0 : -3.5), straight);
      case lie::replays: {
        const auto n = past_.size();
        auto plan = past_[std::min(turns_++ % 40, n - 1)];
        plan.start = honest.start;
        return plan;
      }
      case lie::through: {
        constexpr double brisk_mps2 = 1.2, top_mps = 8;
        const auto until_s = (top_mps - from.speed_mps) / brisk_mps2;
        return made(
            from, now, [=](double t) { return t < until_s ? brisk_mps2 : 0.0; },
            straight);
      }
    }
    return honest;
  }

  static world::trajectory moved_right(world::trajectory plan, double by_m) {
    for (auto& p : plan.points)
      p.at = p.at
             + by_m * point{std::sin(p.heading_rad), -std::cos(p.heading_rad)};
    return plan;
  }

  // The braking that ends where the way meets another lane.
  double stop_on_crossing(const world::trajectory_point& from) const {
    const auto& map = world_.streets->map;
    const auto front_m = world::vehicle_params{}.front_m;
    auto nearest_m = 1e9;
    const auto sequence = way_->sequence();
    for (std::size_t i = 0; i < sequence.size(); ++i)
      for (const auto& meeting : map.conflicts())
        for (const auto& [lane, from_m, to_m] :
             {std::tuple{meeting.lane_a, meeting.from_a_m, meeting.to_a_m},
              std::tuple{meeting.lane_b, meeting.from_b_m, meeting.to_b_m}})
          if (lane == sequence[i]
              && meeting.how == world::conflict::kind::crossing) {
            auto ahead_m = way_->start_of_m(i) + (from_m + to_m) / 2 - front_m
                           - std::fmod(from.s_m, way_->length_m());
            if (way_->closed() && ahead_m < -1)
              ahead_m += way_->length_m();
            if (ahead_m > -1)
              nearest_m = std::min(nearest_m, ahead_m);
          }
    const auto v = from.speed_mps;
    if (nearest_m <= 1)
      return -3;
    const auto needed = v * v / (2 * nearest_m);
    if (needed > 1)
      return -std::min(needed, 3.5);
    return v < 8 ? 1.0 : 0.0;
  }

  std::shared_ptr<offloading::service_function> honest_;
  actors::service_world world_;
  offloading::provider_context provider_;
  station_id station_; // of the vehicle
  std::shared_ptr<liars> all_;
  world::route_ptr way_;
  double from_m_ = 0;
  std::optional<time_point> began_;
  world::trajectory said_, first_;
  std::deque<world::trajectory> past_;
  std::size_t turns_ = 0;
  std::uint16_t update_ = 0;
  messages::etsi::mcm word_;
  std::vector<messages::maneuver_waypoint> room_;
};

/// Planning at a provider whose functions lie.
class lying_at_provider final : public real_at_provider {
public:
  lying_at_provider(std::shared_ptr<offloading::provider_service> honest,
                    actors::service_world world,
                    offloading::provider_context provider,
                    std::shared_ptr<liars> all)
      : real_at_provider{std::move(honest)}, world_{std::move(world)},
        provider_{std::move(provider)}, all_{std::move(all)} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id vehicle) override {
    return std::make_shared<lying_function>(
        real_at_provider::make_function(vehicle), world_, provider_, vehicle,
        all_);
  }

private:
  actors::service_world world_;
  offloading::provider_context provider_;
  std::shared_ptr<liars> all_;
};

} // namespace

std::optional<lie> lie_of(std::string_view name) {
  const auto found = std::ranges::find(lie_names, name);
  if (found == lie_names.end())
    return std::nullopt;
  return static_cast<lie>(found - lie_names.begin());
}

actors::service_type_ptr lying_service(actors::service_type_ptr honest,
                                       lie what, duration after) {
  const auto all = std::make_shared<liars>();
  all->what = what;
  all->after = after;
  return std::make_shared<changed_service>(
      std::move(honest),
      [all](offloading::service& service, const actors::service_world& world) {
        service.at_provider = [real = service.at_provider, world,
                               all](const auto& provider) {
          return std::make_shared<lying_at_provider>(real(provider), world,
                                                     provider, all);
        };
      });
}

} // namespace sofof::experiments::torture
