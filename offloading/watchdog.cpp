// A watchdog watches one session until it has found a violation of it.
#include "offloading/watchdog.hpp"

#include <cassert>
#include <utility>

namespace sofof::offloading {

void watchdog::limit(const messages::qos_limits& limits) {
  assert(limits.max_latency > duration{0});
  assert(limits.max_input_age > duration{0});
  assert(limits.max_interarrival == limits_.max_interarrival);
  limits_ = limits;
}

void watchdog::arm(const messages::session_id& session, time_point first) {
  assert(limits_.max_latency > duration{0});
  assert(limits_.max_interarrival > duration{0});
  assert(limits_.max_input_age > duration{0});
  watched_ = session;
  gaps_ = gap_monitor{limits_.max_interarrival};
  gaps_.arrived(first);
  useless_.reset();
}

bool watchdog::disarm(const messages::session_id& session) {
  if (watched_ != session)
    return false;
  watched_.reset();
  return true;
}

std::optional<messages::qos_violation>
watchdog::on_arrival(const messages::arrival& result, time_point now) {
  assert(result.session.is_remote());
  assert(result.received <= now);
  if (watched_ != result.session)
    return std::nullopt;
  gaps_.arrived(result.received);
  useless_.reset();
  if (!in_time(result.created, result.received, limits_.max_latency))
    return found(messages::qos_breach::latency, now,
                 in_words("qos_latency", result.received - result.created,
                          limits_.max_latency));
  if (!in_time(result.input_at, result.received, limits_.max_input_age))
    return found(messages::qos_breach::input_age, now,
                 in_words("qos_input_age", result.received - result.input_at,
                          limits_.max_input_age));
  return std::nullopt;
}

void watchdog::on_useless(const messages::session_id& session,
                          messages::implausibility found) {
  if (watched_ == session)
    useless_ = std::move(found);
}

std::optional<time_point> watchdog::deadline() const {
  if (!watched_)
    return std::nullopt;
  return gaps_.deadline();
}

std::optional<messages::qos_violation> watchdog::on_deadline(time_point now) {
  if (!watched_ || !gaps_.too_long(now))
    return std::nullopt;
  return found(
      messages::qos_breach::gap, now,
      in_words("qos_gap", now - gaps_.last(), limits_.max_interarrival));
}

messages::qos_violation watchdog::found(messages::qos_breach breach,
                                        time_point now, std::string why) {
  assert(watched_);
  assert(breach != messages::qos_breach::gap || gaps_.too_long(now));
  messages::qos_violation violation{
      .session = *watched_, .breach = breach, .at = now, .why = std::move(why)};
  if (breach == messages::qos_breach::gap && useless_) {
    violation.breach = messages::qos_breach::implausible;
    violation.why = std::move(useless_->why);
    violation.check = std::move(useless_->check);
    useless_.reset();
  }
  watched_.reset();
  return violation;
}

} // namespace sofof::offloading
