// Tells the draws of one message apart.
#pragma once

#include <cstdint>

namespace sofof::channel {

/// The third part of a draw's address, beside stream and number. What has a
/// lane in common has the draw in common.
enum draw_lane : std::uint32_t {
  joint_lane, ///< Of computing time and network delay together.
  computing_lane,
  network_lane,
  airtime_lane,
  loss_lane,
  spike_lane,
  spike_length_lane,
  renewal_lane, ///< Whether a draw is that of the number before.
  host_lane,
  host_wait_lane,
  overtaken_lane,
  overtaken_by_lane,
  copied_lane,
  copied_after_lane
};

} // namespace sofof::channel
