// When to send a CPM, and which of the perceived objects go into it.
#pragma once

#include "messages/v2x/generation_rules.hpp"
#include "world/sensing/perception.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace sofof::messages {

/// A perceived object that is recognised from one look to the next.
struct known_object {
  std::uint32_t id = 0; ///< The same as long as it is known.
  world::perceived_object what;
};

/// Decides when to send CPMs and what about. A station asks every 100 ms or
/// more often, with all that it perceives, and sends at once what it is told
/// to.
///
/// * An object is due when it is new, when its motion is news since it was
///   told last, and a second after it was told last.
/// * Sensors are told of in the first CPM, and then every second.
/// * T_GenCpm after the last CPM, one is sent if an object or the sensors are
///   due: after a second (T_GenCpmMax) in any case.
/// * More objects than a CPM holds: those that wait for longest go first, new
///   ones before all, and of equals the lower ids; the others wait.
///
/// Left out: persons and animals, which are told of all together twice a
/// second; the streets here hold vehicles and obstacles only (they would be
/// `is_due`'s business). An object that is not due yet is not sent ahead of
/// its time to save a message.
///
/// Source: TS 103 324 V2.1.1, section 6.1; TR 103 562 V2.1.1, section 4.3.4.
class cpm_trigger {
public:
  /// Of PerceivedObjectContainer, TR 103 562; TS 103 324 would take 255.
  static constexpr std::size_t most_objects = 128;

  struct decision {
    bool send = false;
    bool sensor_information = false; ///< With those containers.
    /// Which objects, as rising indices into what is perceived; valid until
    /// the next check.
    std::span<const std::uint32_t> objects;
  };

  /// @param period  T_GenCpm: between two CPMs at least, 100 ms to 1 s.
  explicit cpm_trigger(generation_rule rule = generation_rule::triggered,
                       duration period = generation::shortest);

  /// Decides for `now`; what it says is taken for done. Who is not perceived
  /// any more is forgotten. No heap, once it has seen as many as there are.
  /// @param now        Not earlier than the time before; else nothing is sent.
  /// @param perceived  Each object once, in any order.
  decision check(time_point now, std::span<const known_object> perceived);

private:
  struct told_object {
    std::uint32_t id;
    time_point at;
    told_motion motion;
  };
  const told_object* find(std::uint32_t id) const;
  bool is_due(time_point now, const known_object& x) const;
  void choose(time_point now, std::span<const known_object> perceived);
  void remember(time_point now, std::span<const known_object> perceived);

  generation_rule rule_;
  duration period_;
  bool is_first_ = true;
  time_point last_, last_sensors_;         // unless it is the first
  std::vector<told_object> told_, before_; // in order of id
  std::vector<std::uint32_t> chosen_;
};

} // namespace sofof::messages
