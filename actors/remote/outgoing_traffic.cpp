// What vehicles send to a provider on another host all the time, and when. What
// waits when the way stalls, and what is left out:
// network/flow/conflating_queue.
#include "actors/remote/outgoing_traffic.hpp"

#include "base/protocol.hpp"

#include <algorithm>
#include <utility>

namespace sofof::actors {

namespace {

/// Stations begin so long after each other.
constexpr duration between_stations = std::chrono::milliseconds{5};
constexpr duration all_stations = std::chrono::seconds{1}; ///< At most.

} // namespace

outgoing_traffic::outgoing_traffic(std::vector<station_id> stations)
    : stations_{std::move(stations)}, queue_{streams_per_station
                                                 * stations_.size(),
                                             protocol::silence_limit} {}

std::vector<outgoing_traffic::turn> outgoing_traffic::open(time_point first) {
  is_open_ = true;
  std::vector<turn> all;
  for (const auto station : stations_) {
    turns_.insert_or_assign(station, first);
    all.push_back({station, first});
    const auto n = static_cast<std::int64_t>(stations_.size());
    first += std::min(between_stations, all_stations / n);
  }
  return all;
}

void outgoing_traffic::close() {
  is_open_ = false;
  turns_.clear();
  queue_.clear();
}

std::optional<outgoing_traffic::message>
outgoing_traffic::offer(station_id station, const messages::its_pdu& x,
                        time_point now) {
  const auto stream = messages::stream_of(station, x);
  if (stream.of == messages::stream_id::what::cam)
    cams_.insert_or_assign(station, last_cam{x, now});
  return offer(stream, its_message{station, x}, now);
}

std::optional<outgoing_traffic::message>
outgoing_traffic::offer(const messages::service_input& input, time_point now) {
  return offer(
      messages::stream_of(input.session, messages::stream_id::what::input),
      input, now);
}

std::optional<outgoing_traffic::message>
outgoing_traffic::offer(const messages::stream_id& stream, message x,
                        time_point now) {
  if (!is_open_ || is_waiting(stream.station))
    return std::nullopt;
  return queue_.offer(stream, std::move(x), now);
}

std::optional<outgoing_traffic::message>
outgoing_traffic::begin(station_id station, time_point now) {
  const auto turn = turns_.find(station);
  if (turn == turns_.end() || now < turn->second)
    return std::nullopt;
  turns_.erase(turn);
  const auto last = cams_.find(station);
  if (last == cams_.end() || now - last->second.made > protocol::cam_timeout)
    return std::nullopt;
  const auto& cam = last->second.content;
  return offer(messages::stream_of(station, cam), its_message{station, cam},
               now);
}

std::optional<outgoing_traffic::message>
outgoing_traffic::acknowledge(const messages::stream_id& stream,
                              time_point now) {
  return queue_.acknowledge(stream, now);
}

void outgoing_traffic::forget(const messages::session_id& ended) {
  queue_.forget(messages::stream_of(ended, messages::stream_id::what::input));
}

} // namespace sofof::actors
