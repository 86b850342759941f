// How much a peer may send, by all its connections together.
#pragma once

#include "base/time.hpp"
#include "network/flow/token_bucket.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace sofof::actors {

/// What is bounded for one peer, per second.
struct frame_bounds {
  double frames_s = 0;
  double octets_s = 0;
};

/// @returns what a peer may send that speaks for so many stations: several
/// times what CAMs, CPMs, inputs or results, their acknowledgements and the
/// protocol need.
frame_bounds bounds_for(std::size_t stations);

/// What one peer may still send. Twice the bounds may come at once: a process
/// that stood still is heard afterwards.
class frame_allowance {
public:
  explicit frame_allowance(frame_bounds bounds);

  /// Takes a frame of so many octets.
  /// @returns why it must not be handled; empty: it may.
  std::string_view objection(std::size_t octets, time_point now);

  /// @returns whether all that was taken has come back by `now`.
  bool is_whole(time_point now) const;

private:
  network::token_bucket frames_;
  network::token_bucket octets_;
  time_point last_ = time_point::min();
};

/// The allowances of peers that are known by name. A peer gets no more by
/// connecting again, nor by several connections.
class frame_allowances {
public:
  /// @param bounds  The same at each call for a peer.
  /// @returns what is left to this peer.
  std::shared_ptr<frame_allowance> of(const std::string& peer,
                                      frame_bounds bounds, time_point now);

  /// @returns for how many peers one is remembered: those with a connection,
  /// and those that have sent something in the last two seconds.
  std::size_t size() const { return by_peer_.size(); }

private:
  std::map<std::string, std::shared_ptr<frame_allowance>> by_peer_;
};

} // namespace sofof::actors
