// A connected stranger tells of cars that are not there: whom that delays, and
// for how long. All actors are the real ones, in virtual time.
#include "base/random.hpp"
#include "messages/v2x/cam_content.hpp"
#include "messages/v2x/encoded.hpp"
#include "messages/v2x/object_list.hpp"
#include "messages/v2x/perception.hpp"
#include "scenario/build.hpp"
#include "scenario/load.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/memory_sink.hpp"

#include <caf/send.hpp>
#include <caf/typed_event_based_actor.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::scenario;
using namespace sofof::test;
using namespace sofof::world;
using namespace std::chrono_literals;

namespace {

constexpr station_id victim = 101;
constexpr sender_id certificate = sender_id::rep{1} << 63 | 5;
constexpr duration begins = 8s, talks = 60s;

/// Where on its way the vehicle is, and the way.
struct position {
  double s_m, speed_mps;
  const route* way;

  /// @returns a car of ours so far ahead of its rear axle.
  cam car_ahead(double ahead_m, double speed = 0) const {
    const auto p = way->path().at(s_m + ahead_m);
    cam c;
    c.position = p.at;
    c.heading_rad = p.heading_rad;
    c.speed_mps = speed;
    return c;
  }
};

/// What the attacker says every 100 ms.
struct words {
  std::vector<cam> cams;                 // each with its station
  std::vector<perceived_object> objects; // in a CPM of station 201
};
using attack = std::function<words(duration, const position&)>;

/// Whom the provider can answer.
requester_actor::behavior_type deaf(requester_actor::pointer) {
  return {
      [](const service_result&) {},
      [](const service_offer&) {},
      [](const session_digest&) {},
      [](const service_response&, const std::vector<provider_manager_actor>&) {
      },
      [](const service_end&) {},
  };
}

/// Sends in the attacker's name.
class attacker {
public:
  attacker(caf::actor_system& sys, const georeference& where, provider_actor to)
      : where_{where}, to_{std::move(to)}, ear_{sys.spawn(deaf)} {}
  ~attacker() { caf::anon_send_exit(ear_, caf::exit_reason::user_shutdown); }
  attacker(const attacker&) = delete;
  attacker& operator=(const attacker&) = delete;

  void say(const words& what, time_point now) {
    for (auto c : what.cams) {
      c.at = now;
      send(encoded(make_cam(c, {}, where_)));
    }
    if (what.objects.empty())
      return;
    std::vector<known_object> known;
    for (const auto& x : what.objects)
      known.push_back({static_cast<std::uint32_t>(known.size()), x});
    cam self;
    self.station = 201;
    self.at = now;
    self.position = {-400, -400};
    send(encoded(make_cpm_tr103562({self, now, known, known.size(), nullptr},
                                   {}, where_)));
  }

private:
  void send(its_pdu message) {
    message.sender = certificate;
    caf::anon_send(to_, std::move(message), ear_);
  }

  const georeference& where_;
  provider_actor to_;
  requester_actor ear_;
};

struct outcome {
  std::vector<track_record> tracks; // of the victim
  std::size_t doubted = 0;
  std::size_t collisions = 0;

  /// @returns when it came to that place of its way.
  double time_at_s(double s_m) const {
    const auto x = std::ranges::find_if(
        tracks, [&](const track_record& r) { return r.ego.s_m >= s_m; });
    return x == tracks.end() ? 1e9 : to_seconds(x->at - tracks.front().at);
  }
};

outcome drive(const scenario_definition& s, const attack& says) {
  auto records = std::make_shared<memory_sink>();
  const auto time = make_virtual_runtime();
  const auto actors = build(time->system(), s, records, time->clock(), true);
  const georeference where{geo_frame{s.world->map.origin()}, time->clock()};
  const auto start = time->now();
  {
    attacker liar{time->system(), where, actors.providers.front()};
    for (auto t = 0ms; t < s.length; t += 100ms) {
      time->run_until(start + t);
      const auto own = std::ranges::find(
          records->tracks.rbegin(), records->tracks.rend(), victim,
          [](const track_record& r) { return r.ego.own.station; });
      if (t < begins || t >= begins + talks || own == records->tracks.rend())
        continue;
      liar.say(says(t - begins, {own->ego.s_m, own->ego.own.speed_mps,
                                 s.world->routes.front().get()}),
               time->now());
    }
    time->run_until(start + s.length);
  }
  dismiss(actors, *time);
  outcome all;
  for (const auto& r : records->tracks)
    if (r.ego.own.station == victim)
      all.tracks.push_back(r);
  for (const auto& e : records->events)
    all.doubted += e.what == event_type::doubted ? 1 : 0;
  all.collisions = records->collisions.size();
  return all;
}

perceived_object object_of(const cam& c) {
  return {c.position + 1.47 * unit_vector(c.heading_rad),
          c.heading_rad,
          c.speed_mps,
          0,
          c.length_m,
          c.width_m};
}

cam of(station_id who, cam c) {
  c.station = who;
  return c;
}

struct named_attack {
  const char* name;
  attack says;
};

named_attack nobody() {
  return {"nobody", [](duration, const position&) { return words{}; }};
}

named_attack appears_at(double ahead_m) {
  const auto place = std::make_shared<cam>();
  return {"stands", [=](duration t, const position& p) {
            if (t == 0s)
              *place = of(201, p.car_ahead(ahead_m));
            return words{{*place}, {}};
          }};
}

std::vector<named_attack> attacks() {
  const auto stands = std::make_shared<cam>();
  const random_stream dice{20, "ghosts"};
  return {
      nobody(),
      appears_at(40),
      {"flickers 25 m ahead",
       [=](duration t, const position& p) {
         if (t % 2500ms == 0s)
           *stands = of(201, p.car_ahead(25));
         return t % 2500ms < 1s ? words{{*stands}, {}} : words{};
       }},
      {"goes before it, slower",
       [](duration, const position& p) {
         return words{{of(201, p.car_ahead(15, 0.7 * p.speed_mps))}, {}};
       }},
      {"is anywhere ahead",
       [=](duration t, const position& p) {
         return words{
             {of(201, p.car_ahead(dice.uniform(
                          12, 60, static_cast<std::uint64_t>(t / 1ms))))},
             {}};
       }},
      {"is ten stations in turn",
       [=](duration t, const position& p) {
         const auto who = 201 + static_cast<station_id::rep>(t / 600ms) % 10;
         if (t % 600ms == 0s)
           *stands = of(who, p.car_ahead(25));
         return words{{*stands}, {}};
       }},
      {"is told of in CPMs",
       [=](duration t, const position& p) {
         if (t % 1500ms == 0s)
           *stands = p.car_ahead(25);
         return words{{}, {object_of(*stands)}};
       }},
      {"sways",
       [=](duration t, const position& p) {
         if (t == 0s)
           *stands = of(201, p.car_ahead(40));
         auto c = *stands;
         c.position =
             c.position + std::sin(to_seconds(t)) * unit_vector(c.heading_rad);
         return words{{c}, {}};
       }},
      {"comes towards it",
       [](duration t, const position& p) {
         auto c = p.car_ahead(120 - 10 * to_seconds(t % 9s), 10);
         c.heading_rad += 3.14159;
         return words{{of(201, c)}, {}};
       }},
  };
}

void delays(const std::vector<named_attack>& ghosts,
            const std::vector<std::string>& options, double limit_s) {
  auto all = std::vector<std::string>{"duration=85s",
                                      "fleet.0.count=1",
                                      "policies.lodm=always",
                                      "policies.codm=always",
                                      "provider.0.area_radius_m=100000",
                                      "record.tracks_period=100ms"};
  all.insert(all.end(), options.begin(), options.end());
  const auto s = load_scenario(SOFOF_SOURCE_DIR "/config/ulm_lehr.toml", all);
  std::optional<outcome> alone;
  for (const auto& [name, says] : ghosts) {
    const std::string what = name;
    CAPTURE(what);
    const auto with = drive(s, says);
    if (!alone) {
      alone = with;
      CHECK(with.doubted == 0);
      continue;
    }
    // Up to where it would be seven seconds after the last word.
    const auto goal_m = alone->tracks[750].ego.s_m;
    const auto delay_s = with.time_at_s(goal_m) - alone->time_at_s(goal_m);
    MESSAGE("a ghost that " << what << ": " << delay_s << " s later, "
                            << with.doubted << " doubted");
    CHECK(delay_s <= limit_s);
    CHECK(with.doubted >= 1);
    CHECK(with.doubted <= 30);
    CHECK(with.collisions == 0);
  }
}

} // namespace

TEST_CASE("a ghost that talks for a minute delays a planned car that sees the "
          "place itself by 2 s at most") {
  delays(attacks(), {"provider.0.sensor.0.range_m=1"}, 2);
}

TEST_CASE("a ghost that talks for a minute delays a planned car by 2 s at most "
          "where the provider has a sensor, too") {
  delays(attacks(), {}, 2);
}

TEST_CASE("a ghost that appears within braking distance is believed in until "
          "the next CPM, or for 0.4 s where a sensor looks") {
  delays({nobody(), appears_at(20)}, {"provider.0.sensor.0.range_m=1"}, 2);
  delays({nobody(), appears_at(20)},
         {"provider.0.sensor.0.range_m=1000", "v2x.cpm=off"}, 2);
}
