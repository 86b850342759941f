// The own function runs along, and comes home.
#include "offloading/source_selector.hpp"

#include <cassert>
#include <utility>

namespace sofof::offloading {

void source_selector::on_home_is_near(time_point now) {
  pass(now);
  if (!is_remote())
    return;
  warm_.foresee(now);
  if (!own_runs_along_)
    run_along(now);
}

/// @returns whether the own function has been called for the newest input.
bool source_selector::run_along(time_point now, bool at_once) {
  const auto runs = is_remote() && warm_.runs_along(now);
  if (runs)
    call_own(now, at_once);
  else if (std::exchange(own_runs_along_, false)) {
    drop_own();
    port_.rest();
  }
  return runs;
}

/// As a provider that stands by, it runs one cycle, from the result in use.
void source_selector::call_own([[maybe_unused]] time_point now, bool at_once) {
  assert(is_remote() && warm_.runs_along(now));
  if (!std::exchange(own_runs_along_, true))
    drop_own();
  auto input = newest_;
  input.standby = true;
  input.at_once = at_once;
  port_.run_along(std::move(input));
}

/// A cycle besides the grid may be done before one that began earlier.
void source_selector::on_own_result(const messages::service_result& result,
                                    time_point now) {
  assert(!result.session.is_remote());
  assert(result.created <= now);
  ++work_.computed;
  work_.computing += result.timing.computing;
  if (result.cycle < last_own_cycle_) {
    ++work_.along;
    return;
  }
  last_own_cycle_ = result.cycle;
  if (is_remote())
    take_own(result, now);
  else if (options().per_input || result.created >= believed_from_)
    use(result, now);
}

void source_selector::take_own(const messages::service_result& result,
                               [[maybe_unused]] time_point now) {
  assert(is_remote());
  assert(result.created <= now);
  if (!warm_.is_on())
    return; // it had begun before a provider took over
  drop_own();
  newest_own_ = result;
}

/// It was computed for nothing.
void source_selector::drop_own() {
  work_.along += newest_own_.has_value();
  newest_own_.reset();
}

void source_selector::await_missed_result() {
  missing_timer_ = ++timers_;
  port_.wake_at(warm_.missed_at() + duration{1}, missing_timer_);
}

/// A result is missing, unless one has come meanwhile.
void source_selector::on_missed_result(time_point now) {
  missing_timer_ = 0;
  if (!is_remote())
    return;
  if (now <= warm_.missed_at()) {
    await_missed_result();
    return;
  }
  assert(now > warm_.missed_at());
  warm_.foresee(now);
  // Its latest result may begin on one that is not in use any more.
  if (!own_runs_along_ || !options().per_input)
    call_own(now);
}

/// @returns the own function's result that can be used at once, if any.
std::optional<messages::service_result>
source_selector::ready(time_point now) const {
  assert(!newest_own_ || !newest_own_->session.is_remote());
  assert(!newest_own_ || newest_own_->cycle <= last_own_cycle_);
  if (!own_runs_along_ || !newest_own_
      || now - newest_own_->created > patience_periods * options().period)
    return std::nullopt;
  if (!newest_.in_use.empty()
      && !own().continues(newest_.in_use, newest_own_->what, now))
    return std::nullopt;
  return newest_own_;
}

/// No provider runs it any more.
void source_selector::come_home(const messages::service_end& end,
                                time_point now) {
  assert(!is_remote());
  trace_.add(step::unwatched, end.session, now);
  port_.watch_end(end);
  record_work();
  std::optional<messages::service_result> at_once;
  if (end.reason == messages::end_reason::implausible) {
    newest_.in_use = {}; // the own function does not go on from that
    if (own_runs_along_)
      believed_from_ = now;
  } else {
    at_once = ready(now);
  }
  own_runs_along_ = false;
  warm_.end();
  if (at_once)
    newest_own_.reset();
  drop_own();
  assert(!own_runs_along_);
  assert(!newest_own_);
  if (!at_once)
    port_.go_local(newest_);
  trace_.add(step::source,
             messages::session_id{0, setup_.station, setup_.service.name, 0},
             now);
  port_.announce_source(false);
  if (!at_once)
    return;
  use(*at_once, now);
  port_.go_local(newest_);
}

} // namespace sofof::offloading
