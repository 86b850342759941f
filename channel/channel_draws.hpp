// How long messages travel: the draws of one vehicle.
// All of them are exogenous: a function of (seed, vehicle, provider,
// direction, number) and, for what happens at a time, of that time.
#pragma once

#include "base/ids.hpp"
#include "base/random.hpp"
#include "base/time.hpp"
#include "channel/channel_profile.hpp"
#include "channel/outage_process.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace sofof::channel {

/// Where a message goes: to the provider, or to the vehicle.
enum class direction { up, down };

/// What is numbered with it. Each class has draws of its own in each
/// direction, so that protocol messages never shift the noise of results.
enum class message_class {
  result, ///< Numbered by planning cycle; all of one cycle share a draw.
  other,  ///< Numbered as they are sent.
  digest, ///< Likewise; in no order with others, so that it delays none.
};

/// One message as the channel sees it.
struct message_id {
  direction to = direction::down;
  message_class kind = message_class::result;
  std::uint64_t number = 0;
};

/// Draws for one vehicle at one provider. Cheap to make and to copy.
class channel_draws {
public:
  /// @param radio  Over which the vehicle reaches the provider: providers of
  ///               one radio are reached, and stalled, at the same times.
  /// @throws std::invalid_argument  when the profile replays a trace and has
  /// no samples.
  channel_draws(std::shared_ptr<const channel_profile> profile,
                random_stream seed, station_id station, std::uint32_t provider,
                std::string_view radio = {});

  /// Network delay without queues and stalls.
  /// @param sent  Matters when a trace is replayed, or where delays drift.
  duration network_delay(const message_id& m, time_point sent) const;

  /// Network delay of result number `cycle`.
  duration downlink_delay(std::uint64_t cycle, time_point sent) const {
    return network_delay({direction::down, message_class::result, cycle}, sent);
  }

  /// Network delay of all that stall number `stall` held back: it is released
  /// at the stall's end and travels together.
  duration burst_delay(direction to, std::uint64_t stall) const;

  /// Time that a message occupies the radio cell.
  /// @param octets  Of the message on the air.
  duration airtime(const message_id& m, std::size_t octets) const;

  /// @param fading  Whether the connection is in its bad state.
  /// @param more    Of where the vehicle is, besides: a probability in [0, 1].
  bool lost(const message_id& m, bool fading, double more = 0) const;

  /// @param vehicle  Where it is, m; nullopt: nobody knows.
  /// @returns what the areas of the channel make of that place.
  place_quality quality_at(const std::optional<point>& vehicle) const;

  /// Stalls of this vehicle, for both directions and all providers of a radio.
  /// @throws std::invalid_argument  when they leave no time in between.
  outage_process stalls() const;

  /// Times in which this vehicle's connection is in the bad state, likewise.
  outage_process fades() const;

  /// @param since_start  Of the run.
  /// @returns whether nothing gets through in this direction then, for anybody.
  bool is_out(direction to, duration since_start) const;

  /// @returns how much longer a message takes, without making others wait.
  duration overtaken_by(const message_id& m) const;

  /// @returns how long after a message a copy of it arrives, if one does.
  std::optional<duration> copied_after(const message_id& m) const;

private:
  std::optional<duration> disordered(const message_id& m, double probability,
                                     std::uint32_t lane,
                                     std::uint32_t by_lane) const;
  duration drawn_delay(const message_id& m, time_point sent) const;
  double drift(time_point sent) const;
  struct streams {
    random_stream results;
    random_stream others;
    random_stream digests;
    random_stream bursts;
  };
  streams split(std::string_view direction, std::uint32_t provider) const;
  const streams& of(direction to) const;
  const random_stream& of(const message_id& m) const;

  random_stream of_radio_; // of this vehicle
  random_stream drift_;
  streams up_;
  streams down_;
  std::shared_ptr<const channel_profile> profile_;
  double trace_start_s_ = 0;
};

/// @returns the draws of a vehicle's results from a provider, by which a
/// `provider_compute` computes them; those of a channel that is made of the
/// same.
random_stream result_draws(const random_stream& seed, station_id station,
                           std::uint32_t provider, std::string_view radio = {});

} // namespace sofof::channel
