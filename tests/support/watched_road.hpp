// Bodies that drive, sensors that look at them, and stations that tell of
// themselves: what a provider's plausibility is fed with, step by step.
#pragma once

#include "base/random.hpp"
#include "planners/plausibility/plausibility.hpp"
#include "planners/scene/object_tracker.hpp"
#include "world/sensing/sensors.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::test {

using namespace std::chrono_literals;

/// A car that tells where it is; its numbers count from 1.
struct telling_car {
  world::perceived_object is; ///< Where it really is.
  bool exists = true;         ///< Else it is made up.
  bool tells = true;          ///< CAMs, ten a second.
  bool sends_cpms = false;    ///< Ten a second, about what it sees.
  double range_m = 100;       ///< Of its sensor, which looks all round.
  sender_id sender = 0;       ///< 0: its own.
};

class watched_road {
public:
  static constexpr duration step = 50ms;

  explicit watched_road(std::vector<world::building> houses = {})
      : truth{houses}, doubts{houses} {}

  /// Lets time pass by one step: all move on, tell, and look.
  void pass() {
    now += step;
    std::vector<world::road_body> bodies;
    for (std::size_t k = 0; k < cars.size(); ++k) {
      auto& c = cars[k];
      c.is = planners::moved_on(c.is, to_seconds(step));
      if (c.exists)
        bodies.push_back(body(number(k), c.is));
    }
    truth.place(bodies);
    const auto is_time = ++steps_ % 2 == 0;
    for (std::size_t k = 0; is_time && k < cars.size(); ++k)
      if (cars[k].tells)
        hear(number(k), sender_of(number(k)),
             k < told.size() && told[k] ? *told[k] : cars[k].is);
    for (std::uint32_t k = 0; k < sensors.size(); ++k)
      look(k);
    for (std::size_t k = 0; is_time && k < cars.size(); ++k)
      if (cars[k].exists && cars[k].sends_cpms)
        send_cpm(number(k), cars[k]);
    for (const auto& x : doubts.news(now))
      news.push_back(x);
  }

  void pass(duration d) {
    for (const auto end = now + d; now < end;)
      pass();
  }

  /// A station tells where a body is, between two steps.
  void hear(station_id who, sender_id sender,
            const world::perceived_object& what) {
    if (doubts.on_report(who, sender, {now, what}))
      model.on_report(now, who, what);
  }

  /// @returns whether who plans for `station` believes in a body there.
  bool believes_in(const world::perceived_object& x, station_id station = 0) {
    doubts.believed(now, station, model.tracks(), room_);
    return std::ranges::any_of(room_, [&](const planners::track& t) {
      return distance_m(t.centre(), x.centre) < 2;
    });
  }

  std::size_t doubted() const {
    return static_cast<std::size_t>(
        std::ranges::count(news, true, &planners::station_doubt::begins));
  }

  static station_id number(std::size_t k) {
    return static_cast<station_id>(k + 1);
  }

  static world::road_body body(station_id id,
                               const world::perceived_object& x) {
    return {id,
            {x.centre, x.heading_rad, x.length_m, x.width_m},
            x.speed_mps,
            x.accel_mps2};
  }

  std::vector<telling_car> cars;
  /// What a car tells instead of where it is.
  std::vector<std::optional<world::perceived_object>> told;
  std::vector<world::sensor> sensors; ///< The provider's.
  double loss = 0;                    ///< Of CPMs.
  random_stream air{20, "air"};
  world::scene truth;
  planners::plausibility doubts;
  planners::object_tracker model{{}, {4, 1s}};
  time_point now{100s};
  std::vector<planners::station_doubt> news;

private:
  sender_id sender_of(station_id who) const {
    const auto& c = cars[who.value() - 1];
    return c.sender == 0 ? sender_id{who.value()} : c.sender;
  }

  void look(std::uint32_t k) {
    const auto& s = sensors[k];
    const auto seen = truth.seen_by(s, now);
    model.update(now, seen);
    doubts.judge({k, true, 0}, {now, s.view(), 0, now, seen, {}, seen.size()},
                 model.tracks());
  }

  // All that it sees, but each object is due only once a second.
  void send_cpm(station_id who, const telling_car& c) {
    world::sensor eye{{.range_m = c.range_m},
                      random_stream{who.value(), "eyes"},
                      c.is.centre,
                      c.is.heading_rad,
                      who};
    const auto seen = truth.seen_by(eye, now);
    std::vector<world::perceived_object> due;
    std::vector<std::uint32_t> ids;
    std::size_t all = 0;
    for (std::size_t k = 0; k < cars.size(); ++k) {
      if (number(k) == who || !cars[k].exists)
        continue;
      const auto at = std::ranges::find_if(seen, [&](const auto& x) {
        return distance_m(x.centre, cars[k].is.centre) < 1;
      });
      auto& last = due_[{who, number(k)}];
      if (at == seen.end()) {
        last = {};
        continue;
      }
      ++all;
      if (now < last)
        continue;
      last = now + 1s; // also if the message is lost
      due.push_back(*at);
      ids.push_back(number(k).value());
    }
    if (air.uniform(steps_, who.value()) < loss)
      return;
    model.update(now, due);
    doubts.judge({who.value(), false, sender_of(who)},
                 {now, eye.view(), c.is.speed_mps, now, due, ids, all},
                 model.tracks());
  }

  std::uint64_t steps_ = 0;
  std::map<std::pair<station_id, station_id>, time_point> due_;
  std::vector<planners::track> room_;
};

} // namespace sofof::test
