// A provider that stands by: called when the others do not answer, given up
// when it does not either.
#include "base/protocol.hpp"
#include "offloading/qos_monitor.hpp"
#include "offloading/source_selector.hpp"

#include <cassert>
#include <utility>

namespace sofof::offloading {

void source_selector::on_standby(std::optional<messages::standby> chosen,
                                 time_point now) {
  pass(now);
  standby_ = chosen;
  trace_.add(step::standby, setup_.station, setup_.service.name, chosen, now);
  announce_roles(now);
  await_cycle_after(began_);
}

/// A provider that comes to stand by, or no longer does, learns it by an input.
void source_selector::announce_roles(time_point now) {
  for (auto& x : sources_)
    if (x.in_use && x.knows_it_stands_by != is_standby(x))
      feed(x, now);
}

/// The cycle after one that began at `start` shall be answered.
void source_selector::await_cycle_after(time_point start) {
  began_ = start;
  timer_ = ++timers_;
  if (standby_)
    port_.wake_at(began_ + options().period + standby_->after, timer_);
}

/// One more cycle has begun, or should have; more of them if this process has
/// stood still.
void source_selector::on_timer(std::uint64_t number, time_point now) {
  pass(now);
  assert(number <= timers_);
  if (number == missing_timer_)
    on_missed_result(now);
  if (number != timer_ || !is_remote())
    return;
  assert(standby_);
  assert(options().period > duration{0});
  const auto since = now - standby_->after - began_;
  await_cycle_after(began_ + since / options().period * options().period);
  if (!answers_.hedge_due(began_, now, standby_->after))
    return;
  for (auto& x : sources_)
    if (x.in_use && is_standby(x) && feed(x, now)) {
      trace_.add(step::called, x.session, now);
      ++x.calls_in_vain;
    }
}

/// One of several that has not been in time for long is of no use, nor is one
/// that stands by and does not answer.
void source_selector::give_up_silent(time_point now) {
  assert(in_use() > 1);
  for (auto& x : sources_) {
    assert(x.calls_in_vain >= 0);
    assert(!x.last_in_time || *x.last_in_time <= now);
    const auto silent = is_standby(x) ? x.calls_in_vain * options().period
                                      : now - x.last_in_time.value_or(now);
    if (!x.in_use || x.given_up || silent <= protocol::start_timeout)
      continue;
    x.given_up = true;
    if (const auto& found = x.useless)
      port_.report({x.session, messages::qos_breach::implausible, now, true,
                    found->why, found->check});
    else
      port_.report({x.session,
                    messages::qos_breach::gap,
                    now,
                    true,
                    in_words("qos_gap", silent, protocol::start_timeout),
                    {}});
  }
}

} // namespace sofof::offloading
