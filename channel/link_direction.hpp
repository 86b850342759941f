// One direction of a link: delay, airtime in the shared cell, loss, stalls,
// and delivery in order.
#pragma once

#include "base/time.hpp"
#include "channel/channel_draws.hpp"
#include "channel/outage_process.hpp"
#include "channel/shared_server_queue.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace sofof::channel {

/// What kept a message from getting through, or from doing so in time.
enum class disturbance : std::uint8_t {
  none,
  loss,   ///< Lost by chance.
  outage, ///< Lost, as nothing gets through.
  stall,  ///< Held back until the end of a stall.
  slow,   ///< The network's delay, its own or that of one before, was too long.
};

/// From so long on a message is late by the network, apart from its wait for
/// the cell and its time on the air: the least delay that makes of a period of
/// 50 ms, the default, a gap of 100 ms, which ends an episode by default.
inline constexpr duration slow_delay = std::chrono::milliseconds{50};

/// How a message gets through.
struct passage {
  std::optional<time_point> arrives; ///< nullopt when it is lost.
  disturbance by = disturbance::none;
  /// Of its time on the way, what it waited: for its turn in the cell, for the
  /// end of a stall, or for a message before it.
  duration wait{};
  std::optional<time_point> copy_arrives; ///< If it arrives twice.
  bool is_overtaken = false; ///< It was late, and others did not wait for it.
};

/// Carries the messages of one vehicle one way. Has one owner; only the cell
/// may be shared between threads.
class link_direction {
public:
  /// @param cell  The radio cell's airtime queue, of one worker, shared by
  ///              the vehicles of a cell in this direction; null for none.
  link_direction(channel_draws draws, direction to,
                 std::shared_ptr<shared_server_queue> cell);

  /// The run begins now: outages are counted from here, else from time zero.
  void begin(time_point start) { start_ = start; }

  /// @param sent    When the message leaves; not earlier than before. Calls
  ///                of links that share a cell are in the order of `sent`.
  /// @param number  Number of the draw: the cycle of a result, a running
  ///                number for everything else (streams of their own).
  /// @param octets  What the message takes on the air.
  /// @param vehicle  Where the vehicle is, m, east-north; nullopt: in no area.
  /// @returns among others when it arrives: never before an earlier message,
  /// but for digests, which neither wait nor are waited for, and for messages
  /// that disorder makes others overtake.
  passage carry(time_point sent, message_class kind, std::uint64_t number,
                std::size_t octets = usual_octets,
                const std::optional<point>& vehicle = std::nullopt);

  /// @returns when it arrives; nullopt when it is lost.
  std::optional<time_point> arrival(time_point sent, message_class kind,
                                    std::uint64_t number,
                                    std::size_t octets = usual_octets) {
    return carry(sent, kind, number, octets).arrives;
  }

private:
  channel_draws draws_;
  direction direction_;
  std::shared_ptr<shared_server_queue> cell_;
  outage_process stalls_;
  outage_process fades_;
  time_point start_;
  time_point last_arrival_ = time_point::min();
};

} // namespace sofof::channel
