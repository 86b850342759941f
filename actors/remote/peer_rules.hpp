// What a provider hears of a peer that has been let in.
#pragma once

#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/service.hpp"
#include "network/flow/token_bucket.hpp"

#include <map>
#include <set>
#include <string_view>

namespace sofof::actors {

/// A peer speaks for its own stations only, and each of them may send so much
/// a second: CAMs, CPMs and inputs at 10 Hz or 20, several times over. All that
/// the peer sends is bounded as well. Two seconds of it may come at once, for
/// they may have been held up.
///
/// An objection says why something is not heard, as words about the peer;
/// empty: it is. What is objected to is dropped and recorded (`peer_ignored`,
/// once a second at most); the connection stays. It is cut only by what cannot
/// be read, or by far more frames (frame_allowance.hpp).
class peer_rules {
public:
  explicit peer_rules(const std::set<station_id>& stations);

  /// To anything that the peer sends. To be asked once for each message, first.
  std::string_view objection_to_message(time_point now);

  /// To a message that it sends for this station.
  std::string_view objection_to_sender(station_id station) const;

  /// To the contents of an ITS message of this station, which is the peer's.
  std::string_view objection_to(station_id station,
                                const messages::its_pdu& message,
                                time_point now);

  /// To an input of a station of the peer's.
  std::string_view objection_to(const messages::service_input& input,
                                time_point now);

  /// To the size of a request.
  static std::string_view
  objection_to(const messages::service_request& request);

private:
  std::string_view objection_to_rate(station_id station, time_point now);

  network::token_bucket all_; // for all that the peer sends
  std::map<station_id, network::token_bucket> by_station_;
};

} // namespace sofof::actors
