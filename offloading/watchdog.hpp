// The rules of the QoS watchdog: when results of a session are late or missing.
#pragma once

#include "messages/protocol/qos.hpp"
#include "offloading/qos_monitor.hpp"

#include <optional>
#include <string>

namespace sofof::offloading {

/// Watches one session at a time, and finds at most one violation of it.
/// Source: Dehler & Buchholz 2025, QoS check of the service requester.
///
/// Whoever owns it asks `on_deadline` again at `deadline`, which every result
/// moves: a timer may be set once and again when it has run out in vain.
class watchdog {
public:
  /// @param limits  All of them > 0; results exactly at a limit keep it.
  explicit watchdog(messages::qos_limits limits) : limits_{limits} {}

  /// What results may be from now on: the limit of gaps stays.
  /// @param limits  All of them > 0.
  void limit(const messages::qos_limits& limits);

  /// Watches `session` from now on, and no other.
  /// @param first  When its first result came.
  void arm(const messages::session_id& session, time_point first);

  /// Watches no longer, if it is `session` that it watches.
  /// @returns whether it was.
  bool disarm(const messages::session_id& session);

  /// A result of the session has come.
  /// @returns the violation if it came late, or its input is too old: then the
  /// session is watched no longer. Nullopt for a result of another session.
  /// @param now  When the violation is found, not before the result came.
  std::optional<messages::qos_violation>
  on_arrival(const messages::arrival& result, time_point now);

  /// A result of the session has come that cannot be used; the gap goes on.
  /// @param found  For the violation, if no other result comes in time.
  void on_useless(const messages::session_id& session,
                  messages::implausibility found);

  /// @returns the first moment at which the gap is too long unless another
  /// result comes; nullopt: nothing is watched.
  std::optional<time_point> deadline() const;

  /// @returns the violation if the gap is too long: `implausible`, with a
  /// reason, if results came in it that could not be used, else `gap`. Then
  /// the session is watched no longer.
  std::optional<messages::qos_violation> on_deadline(time_point now);

private:
  messages::qos_violation found(messages::qos_breach breach, time_point now,
                                std::string why);

  messages::qos_limits limits_;
  std::optional<messages::session_id> watched_;
  gap_monitor gaps_{duration{0}};
  // Of results since the last arrival.
  std::optional<messages::implausibility> useless_;
};

} // namespace sofof::offloading
