// Tracks, results and events, by time.
#include "base/text/json.hpp"
#include "experiments/convert/formats.hpp"
#include "experiments/convert/foxglove.hpp"
#include "experiments/convert/geojson.hpp"
#include "experiments/convert/mcap_writer.hpp"
#include "experiments/report/run_files.hpp"
#include "world/vehicle/vehicle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::convert {

namespace {

using foxglove::colour;

constexpr colour street{0.45, 0.45, 0.47, 1}, house{0.6, 0.58, 0.55, 1},
    on_board{0.85, 0.85, 0.85, 1};
constexpr double car_height_m = 1.5;
constexpr double thin_m = 0.1;
constexpr double plan_width_m = 0.4;

/// Of scenes and places on Earth: who looks needs no more.
constexpr double scene_period_s = 0.2;
constexpr double kept_for = 1.5; ///< Periods that a car stays in the scene.

/// Providers by their place in the scenario, round and round.
constexpr colour of_providers[]{{0.00, 0.45, 0.70, 1}, {0.90, 0.62, 0.00, 1},
                                {0.00, 0.62, 0.45, 1}, {0.80, 0.47, 0.65, 1},
                                {0.34, 0.71, 0.91, 1}, {0.84, 0.37, 0.00, 1}};

colour colour_of(std::size_t provider) {
  return of_providers[provider % std::size(of_providers)];
}

/// What of a car has a channel of its own.
struct car_channels {
  mcap_writer::channel location = 0, state = 0;
  std::optional<mcap_writer::channel> result{}; ///< Once it gets one.
  double shown_s = -1;                          ///< In the scene, last.
  bool is_remote = false;                       ///< Its plan, as of then.
  std::size_t provider = 0;                     ///< That planned for it last.
};

class writer {
public:
  writer(const recorded_drive& drive, const sink& put)
      : drive_{drive}, file_{put} {
    const auto add = [this](std::string_view topic,
                            const foxglove::schema& of) {
      return file_.add_channel(topic, of.name, of.json);
    };
    transforms_ = add("/tf", foxglove::frame_transforms);
    scene_ = add("/scene", foxglove::scene_update);
    events_ = add("/events", foxglove::log_message);
    map_ = add("/map", foxglove::geo_json);
    const auto* planning = scenario::planning_service(drive.what);
    planning_ = planning ? planning->name() : std::string_view{};
    period_s_ =
        std::max(scene_period_s, to_seconds(drive.what.record.tracks_period));
  }

  void show_scenery();
  void add(const track_row& x);
  void add(const report::event_line& x);
  void add(const report::cycle_line& x);
  void add(const planned_path& x);
  void finish() { file_.finish(); }

private:
  car_channels& channels_of(std::uint64_t station);
  void show(const track_row& x, car_channels& of);
  std::size_t place_of(const std::string& provider) const;

  const recorded_drive& drive_;
  mcap_writer file_;
  mcap_writer::channel transforms_ = 0, scene_ = 0, events_ = 0, map_ = 0;
  std::string planning_; // the service
  double period_s_ = 0;
  std::map<std::uint64_t, car_channels> cars_;
};

std::size_t writer::place_of(const std::string& provider) const {
  const auto& all = drive_.what.providers;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == provider)
      return i;
  return 0;
}

car_channels& writer::channels_of(std::uint64_t station) {
  const auto [car, is_new] = cars_.try_emplace(station);
  if (is_new) {
    const auto add = [&](std::string_view what, const foxglove::schema& of) {
      return file_.add_channel(fmt::format("/vehicle/{}/{}", station, what),
                               of.name, of.json);
    };
    car->second.location = add("location", foxglove::location_fix);
    car->second.state = add("state", foxglove::vehicle_state);
  }
  return car->second;
}

/// Streets, houses and areas: one entity each, which stays.
void writer::show_scenery() {
  const auto at = drive_.unix_ns(0);
  const auto& map = drive_.what.world->map;
  using line = foxglove::entity::line;
  std::vector<line> lanes, houses, areas;
  for (const auto& one : map.lanes())
    lanes.push_back({one.centre, 2 * one.half_width_m, street});
  for (const auto& one : map.buildings())
    houses.push_back({one.corners, thin_m, house, true});
  std::vector<std::vector<point>> corners;
  for (const auto& one : drive_.what.providers)
    corners.push_back(one.area().corners());
  for (std::size_t i = 0; i < corners.size(); ++i)
    areas.push_back({corners[i], thin_m, colour_of(i), true});
  const foxglove::entity all[]{{.id = "lanes", .lines = lanes},
                               {.id = "houses", .lines = houses},
                               {.id = "areas", .lines = areas}};
  file_.write(scene_, at, foxglove::scene(at, all));
  std::string text = "{\"geojson\":";
  append_quoted(text, feature_collection(scenery_features(drive_)));
  file_.write(map_, at, text + "}");
}

void writer::add(const track_row& x) {
  auto& of = channels_of(x.station);
  of.is_remote = x.remote;
  const auto at = drive_.unix_ns(x.t_s);
  file_.write(transforms_, at,
              foxglove::transform(at, fmt::format("car{}", x.station),
                                  {x.at, x.heading_rad}));
  file_.write(of.state, at,
              fmt::format(R"({{"speed_mps":{:.3f},"accel_mps2":{:.3f},)"
                          R"("lateral_m":{:.3f},"plan_age_ms":{:.3f},)"
                          R"("offloaded":{:d}}})",
                          x.speed_mps, x.accel_mps2, x.lateral_m, x.plan_age_ms,
                          x.remote));
  constexpr double rounding_s = 1e-6;
  if (of.shown_s < 0 || x.t_s - of.shown_s >= period_s_ - rounding_s)
    show(x, of);
}

/// A box in the colour of who plans, and the place on Earth.
void writer::show(const track_row& x, car_channels& of) {
  of.shown_s = x.t_s;
  const auto at = drive_.unix_ns(x.t_s);
  const world::vehicle_params car;
  const auto to_middle_m = (car.front_m - car.rear_m) / 2;
  const foxglove::box body{
      {x.at
           + to_middle_m
                 * point{std::cos(x.heading_rad), std::sin(x.heading_rad)},
       x.heading_rad},
      car.front_m + car.rear_m,
      car.width_m,
      car_height_m,
      x.remote ? colour_of(of.provider) : on_board};
  const auto id = std::to_string(x.station);
  const foxglove::entity entity{
      .id = id, .lifetime_s = kept_for * period_s_, .boxes = {&body, 1}};
  file_.write(scene_, at, foxglove::scene(at, {&entity, 1}));
  constexpr double degrees = 1e-7;
  const auto on_earth = drive_.frame.to_wgs84(x.at);
  file_.write(of.location, at,
              foxglove::location(at, degrees * on_earth.latitude,
                                 degrees * on_earth.longitude));
}

void writer::add(const report::event_line& x) {
  if (x.what == "first_data" && x.of.service == planning_)
    channels_of(x.of.station).provider = place_of(x.of.provider);
  const auto at = drive_.unix_ns(x.t_s);
  const auto is_bad = x.what == "violation" || x.what == "fallback"
                      || x.what == "implausible" || x.what == "collision";
  auto text = x.what;
  for (const auto* more : {&x.of.service, &x.of.provider, &x.detail})
    if (!more->empty())
      text += " " + *more;
  file_.write(
      events_, at,
      foxglove::log(
          at, is_bad ? foxglove::level::warning : foxglove::level::info,
          x.of.station == 0 ? x.of.provider : std::to_string(x.of.station),
          text));
}

void writer::add(const report::cycle_line& x) {
  auto& of = channels_of(x.of.station);
  if (!of.result)
    of.result = file_.add_channel(
        fmt::format("/vehicle/{}/results", x.of.station),
        foxglove::offloading_result.name, foxglove::offloading_result.json);
  std::string text = "{\"service\":";
  append_quoted(text, x.of.service);
  text += ",\"provider\":";
  append_quoted(text, x.of.provider);
  text += fmt::format(R"(,"latency_ms":{:.3f},"used":{:d}}})", x.latency_ms,
                      x.used);
  file_.write(*of.result, drive_.unix_ns(x.received_s), text);
}

/// A line in the colour of who plans, until the next one is told.
void writer::add(const planned_path& x) {
  const auto at = drive_.unix_ns(x.t_s);
  const auto& of = channels_of(x.station);
  const foxglove::entity::line way{
      x.points, plan_width_m, of.is_remote ? colour_of(of.provider) : on_board};
  const auto id = fmt::format("plan of {}", x.station);
  const foxglove::entity entity{
      .id = id, .lifetime_s = kept_for * scene_period_s, .lines = {&way, 1}};
  file_.write(scene_, at, foxglove::scene(at, {&entity, 1}));
}

double time_of(const planned_path& x) {
  return x.t_s;
}
double time_of(const track_row& x) {
  return x.t_s;
}
double time_of(const report::event_line& x) {
  return x.t_s;
}
double time_of(const report::cycle_line& x) {
  return x.received_s;
}

/// A file, and what comes next in it.
template <class File>
class stream {
public:
  explicit stream(File& from) : from_{from}, next_{from.next()} {}
  double next_s() const { return next_ ? time_of(*next_) : INFINITY; }
  void move_to(writer& to) {
    to.add(*next_);
    next_ = from_.next();
  }

private:
  File& from_;
  decltype(std::declval<File&>().next()) next_;
};

} // namespace

void write_mcap(const recorded_drive& drive, const sink& put) {
  writer to{drive, put};
  to.show_scenery();
  track_file track_rows{drive.folder};
  report::event_file event_rows{drive.folder};
  report::cycle_file cycle_rows{drive.folder};
  plan_file plan_rows{drive.folder};
  stream tracks{track_rows};
  stream events{event_rows};
  stream cycles{cycle_rows};
  stream plans{plan_rows};
  for (;;) {
    const auto first = std::min(
        {tracks.next_s(), events.next_s(), cycles.next_s(), plans.next_s()});
    if (std::isinf(first))
      break;
    if (events.next_s() == first)
      events.move_to(to);
    else if (cycles.next_s() == first)
      cycles.move_to(to);
    else if (tracks.next_s() == first)
      tracks.move_to(to);
    else
      plans.move_to(to);
  }
  to.finish();
}

} // namespace sofof::experiments::convert
