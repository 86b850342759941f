// What vehicles send to a provider on another host all the time, and when.
#pragma once

#include "messages/protocol/remote.hpp"
#include "messages/protocol/service.hpp"
#include "network/flow/conflating_queue.hpp"

#include <map>
#include <optional>
#include <variant>
#include <vector>

namespace sofof::actors {

/// CAMs, CPMs and inputs of the vehicles of one process. Of each stream one
/// message is under way and one waits, the latest. Nothing goes out before the
/// provider knows our clock; from then on the stations begin one after the
/// other, for all would ask at once, and a provider that begins to work for a
/// hundred is late for those who came first.
class outgoing_traffic {
public:
  /// A CAM or a CPM.
  struct its_message {
    station_id station = 0; ///< Who sends it.
    messages::its_pdu content;
  };
  using message = std::variant<its_message, messages::service_input>;

  /// When a station may begin.
  struct turn {
    station_id station = 0;
    time_point at;
  };

  /// For each station so many streams are under way at most.
  static constexpr std::size_t streams_per_station = 8;

  explicit outgoing_traffic(std::vector<station_id> stations);

  /// The provider knows our clock.
  /// @param first  When the first station may begin.
  /// @returns the turns of all stations.
  std::vector<turn> open(time_point first);

  bool is_open() const { return is_open_; }

  /// The connection is lost: all that is under way or waits is, too.
  void close();

  /// @returns whether the turn of a station is still to come: to it the
  /// provider is not connected yet.
  bool is_waiting(station_id station) const { return turns_.contains(station); }

  /// A station has a CAM or a CPM. It is kept: a CAM that was made before the
  /// station's turn goes out then.
  /// @returns what is to be sent now.
  std::optional<message> offer(station_id station, const messages::its_pdu& x,
                               time_point now);
  /// The same for the input of a session.
  std::optional<message> offer(const messages::service_input& input,
                               time_point now);

  /// A station's turn has come, unless it is one of an earlier connection.
  /// @returns its latest CAM, to be sent now, for the next one may be a second
  /// off; nothing if that is as old as that of a station that has gone.
  std::optional<message> begin(station_id station, time_point now);

  /// The latest message of a stream has come.
  /// @returns the one that waited, to be sent now.
  std::optional<message> acknowledge(const messages::stream_id& stream,
                                     time_point now);

  /// A session has ended: none of its inputs waits.
  void forget(const messages::session_id& ended);

private:
  std::optional<message> offer(const messages::stream_id& stream, message x,
                               time_point now);

  struct last_cam {
    messages::its_pdu content;
    time_point made;
  };

  std::vector<station_id> stations_;
  network::conflating_queue<messages::stream_id, message> queue_;
  std::map<station_id, last_cam> cams_;
  std::map<station_id, time_point> turns_; // those that have not come
  bool is_open_ = false;
};

} // namespace sofof::actors
