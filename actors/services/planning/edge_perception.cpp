// What a provider knows of the road.
#include "actors/services/planning/edge_perception.hpp"

#include "actors/services/planning/drive_words.hpp"
#include "base/protocol.hpp"
#include "messages/v2x/object_list.hpp"

#include <utility>

namespace sofof::actors {

namespace {

/// Nobody has more vehicles round him; more are made up.
constexpr std::size_t most_stations = 10'000;

/// Who has been heard for so long has told of all that it sees, once.
constexpr duration acquaintance = std::chrono::milliseconds{900};
/// CAMs come once a second, at the latest.
constexpr duration longest_pause =
    messages::generation::longest + protocol::clock_tolerance;

} // namespace

world::perceived_object body_of(const messages::cam& c) {
  const world::vehicle_params ours;
  const auto axle_share = ours.front_m / (ours.front_m + ours.rear_m);
  const auto centre_ahead_m = (axle_share - 0.5) * c.length_m;
  return {c.position + centre_ahead_m * messages::unit_vector(c.heading_rad),
          c.heading_rad,
          c.speed_mps,
          c.accel_mps2,
          c.length_m,
          c.width_m};
}

edge_perception::edge_perception(std::function<time_point()> clock,
                                 std::span<const world::building> houses,
                                 const planners::sighting_noise& noise,
                                 messages::georeference_ptr where)
    : clock_{std::move(clock)}, model_{noise,
                                       {messages::generation::moved_m,
                                        messages::generation::longest}},
      doubts_{houses}, where_{std::move(where)} {}

void edge_perception::on_cam(const messages::cam& c, sender_id from) {
  const auto now = clock_();
  if (protocol::is_of_future(c.at, now))
    return;
  const std::lock_guard lock{mutex_};
  if (doubts_.on_report(c.station, from, {c.at, body_of(c)}))
    model_.on_report(c.at, c.station, body_of(c));
  forget_silent(now);
  if (told_.size() >= most_stations && !told_.contains(c.station))
    return;
  auto& [newest, since] = told_.try_emplace(c.station, c, now).first->second;
  if (c.at - newest.at > longest_pause)
    since = now;
  if (newest.at <= c.at)
    newest = c;
}

void edge_perception::on_objects(const messages::object_list& told,
                                 sender_id from) {
  const auto now = clock_();
  if (protocol::is_of_future(told.at, now)
      || protocol::is_of_future(told.generated, now))
    return;
  const std::lock_guard lock{mutex_};
  auto steady = told;
  doubts_.sift(told.from, told.at, steady.ids, steady.objects);
  model_.update(told.at, steady.objects);
  if (steady.eye)
    doubts_.judge({told.from.value(), false, from}, look_of(steady),
                  model_.tracks());
}

void edge_perception::on_word(const messages::decoded_mcm& word, sender_id) {
  const auto now = clock_();
  if (!where_ || protocol::is_of_future(word.at, now))
    return;
  const std::lock_guard lock{mutex_};
  forget_silent(now);
  if (said_.size() >= most_stations && !said_.contains(word.from))
    return;
  auto& known = said_[word.from];
  if (known.at < word.at)
    known = {word.at,
             drive_of(word, where_->frame, world::vehicle_params{}.rear_m),
             is_claim(word), word.reference};
}

void edge_perception::drives(std::vector<planners::told_drive>& out,
                             station_id station) {
  out.clear();
  const auto now = clock_();
  const std::lock_guard lock{mutex_};
  for (const auto& [who, x] : said_)
    if (who != station && now - x.at <= protocol::cam_timeout)
      out.push_back({who, x.drive, x.is_claimed, x.front});
}

void edge_perception::on_detections(const messages::roadside_detections& view) {
  if (protocol::is_of_future(view.at, clock_()))
    return;
  const std::lock_guard lock{mutex_};
  model_.update(view.at, view.objects);
  doubts_.judge(
      {view.sensor, true, 0},
      {view.at, view.from, 0, view.at, view.objects, {}, view.objects.size()},
      model_.tracks());
}

std::vector<planners::station_doubt> edge_perception::take_doubts() {
  const std::lock_guard lock{mutex_};
  return doubts_.news(clock_());
}

/// A vehicle's sensor is in the middle of its body, as far as CPMs tell; how
/// long it is and how fast, its CAMs do.
planners::road_look
edge_perception::look_of(const messages::object_list& told) const {
  planners::road_look look{
      told.generated, *told.eye, 0, told.at, told.objects, {}, told.perceived};
  if (told.ids.size() == told.objects.size())
    look.ids = told.ids;
  const auto own = told_.find(told.from);
  const auto self = own == told_.end() ? messages::cam{} : own->second.newest;
  look.speed_mps = self.speed_mps;
  look.from.at =
      look.from.at
      + -0.5 * self.length_m * messages::unit_vector(look.from.heading_rad);
  return look;
}

std::optional<messages::cam> edge_perception::told_by(station_id who) const {
  const std::lock_guard lock{mutex_};
  const auto x = told_.find(who);
  if (x == told_.end()
      || clock_() - x->second.newest.at > protocol::cam_timeout)
    return std::nullopt;
  return x->second.newest;
}

bool edge_perception::knows_surroundings_of(station_id who) const {
  const std::lock_guard lock{mutex_};
  const auto x = told_.find(who);
  return x != told_.end() && clock_() - x->second.since >= acquaintance;
}

void edge_perception::tracks(std::vector<planners::track>& out,
                             station_id station) {
  const std::lock_guard lock{mutex_};
  doubts_.believed(clock_(), station, model_.tracks(), out);
}

void edge_perception::forget_silent(time_point now) {
  if (now - tidied_ < protocol::cam_timeout)
    return;
  tidied_ = now;
  std::erase_if(told_, [now](const auto& x) {
    return now - x.second.newest.at > protocol::cam_timeout;
  });
  std::erase_if(said_, [now](const auto& x) {
    return now - x.second.at > protocol::cam_timeout;
  });
}

} // namespace sofof::actors
