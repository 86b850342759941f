// Sources of a service: fed, judged, used, given up.
#include "offloading/source_selector.hpp"

#include "base/protocol.hpp"
#include "offloading/qos_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace sofof::offloading {

namespace {

/// What has been done is recorded so often.
constexpr duration work_period = std::chrono::seconds{1};

std::string in_ms(duration d) {
  return fmt::format("{:.1f} ms", 1e3 * to_seconds(d));
}

std::string in_words(const objection& why) {
  return fmt::format("{} value={:.3f} limit={:.3f}", why.check, why.value,
                     why.limit);
}

/// @returns the narrowest limit that a result may have.
duration least_latency(const service_options& options) {
  return options.latency_by_scene ? options.latency_floor
                                  : options.limits.max_latency;
}

messages::implausibility told(const objection& why) {
  return {in_words(why), std::string{why.check}};
}

} // namespace

source_selector::source_selector(selector_setup setup, selector_port& port)
    : setup_{std::move(setup)}, port_{port},
      trace_{messages::trace_part::selector, sink_of(setup_.trace, port)},
      limits_{options().limits}, answers_{options().period},
      warm_{options().warm_standby, options().limits},
      work_{setup_.station, setup_.service.name} {
  assert(setup_.service.own);
  assert(options().period > duration{0});
  assert(options().limits.max_latency > duration{0});
  assert(options().limits.max_input_age > duration{0});
}

void source_selector::pass(time_point now) {
  assert(now >= now_);
  now_ = now;
}

// Each source has a session of its own. None is in use before a result of it
// has come, and those in use alone are called in vain or given up. While one is
// in use, the watchdog watches by the name of such a one.
bool source_selector::is_consistent() const {
  const auto has_its_own = [this](const source& x) {
    return x.judge && x.session.is_remote()
           && std::ranges::count(sources_, x.session, &source::session) == 1
           && (x.in_use || (!x.given_up && x.calls_in_vain == 0))
           && (!x.in_use || x.last_cycle);
  };
  const auto is_watched = [this](const source& x) {
    return x.in_use && x.session == watched_;
  };
  return std::ranges::all_of(sources_, has_its_own)
         && (!is_remote() || std::ranges::any_of(sources_, is_watched));
}

source_selector::source*
source_selector::find(const messages::session_id& session) {
  const auto i = std::ranges::find(sources_, session, &source::session);
  return i == sources_.end() ? nullptr : &*i;
}

std::ptrdiff_t source_selector::in_use() const {
  return std::ranges::count(sources_, true, &source::in_use);
}

bool source_selector::is_standby(const source& x) const {
  return standby_
         && stands_by(standby_, x.session.provider, in_use() > x.in_use);
}

// -- input --------------------------------------------------------------------

void source_selector::on_input(const messages::service_input& input,
                               time_point now) {
  pass(now);
  assert(work_since_ <= now);
  trace_.add(step::asked,
             messages::session_id{0, setup_.station, setup_.service.name, 0},
             now);
  if (now - work_since_ >= work_period) {
    work_since_ = now;
    record_work();
  }
  newest_.at = input.at;
  newest_.what = input.what;
  newest_.sensed = input.sensed;
  if (setup_.asks_scene || options().latency_by_scene)
    look_at_scene(now);
  if (!run_along(now, input.at_once))
    port_.feed_local(input);
  for (auto& x : sources_)
    if (input_due(x, now) && !(x.in_use && is_standby(x)))
      feed(x, now);
}

bool source_selector::input_due(const source& x, time_point now) const {
  assert(!x.last_sent || *x.last_sent <= now);
  return !x.last_sent || now - *x.last_sent >= options().input_period;
}

/// @returns whether there was anything to send.
bool source_selector::feed(source& x, time_point now) {
  if (newest_.what.empty())
    return false;
  assert(!x.last_sent || *x.last_sent <= now);
  x.last_sent = now;
  x.answers = 0;
  const auto stands = is_standby(x);
  auto input = newest_;
  input.session = x.session;
  input = own().encode_input(std::move(input),
                             !x.in_use || stands || x.knows_it_stands_by);
  if (input.what.empty())
    return false;
  assert(input.session == x.session);
  if (x.knows_it_stands_by && !stands)
    x.last_in_time = now; // patience begins
  input.standby = x.knows_it_stands_by = stands;
  ++work_.inputs;
  port_.feed_remote(std::move(input));
  return true;
}

void source_selector::on_session(const messages::session_id& session,
                                 time_point now) {
  pass(now);
  assert(session.is_remote());
  assert(!find(session));
  trace_.add(step::begun, session, now);
  auto& x = sources_.emplace_back();
  x.session = session;
  x.judge = own().make_judge();
  assert(x.judge);
  feed(x, now);
}

// -- results ------------------------------------------------------------------

void source_selector::on_result(const messages::service_result& result,
                                time_point now) {
  pass(now);
  assert(is_consistent());
  if (!result.session.is_remote()) {
    on_own_result(result, now);
    return;
  }
  ++work_.received;
  auto* x = find(result.session);
  if (!x)
    return;
  if (!(result.cycle > x->last_cycle)) {
    record_now_and_then(
        x->repetition_told, result.session,
        fmt::format("cycle {} after {}", result.cycle, *x->last_cycle), now);
    return;
  }
  x->last_cycle = result.cycle;
  const auto can = can_judge(*x, result, now);
  const auto broken = can ? broken_limit(result, now) : std::string{};
  if (!can)
    record_now_and_then(
        x->doubt_told, result.session,
        in_words("clock_doubt", result.doubt, least_latency(options()) / 2),
        now);
  else if (!broken.empty())
    note(messages::event_type::result_refused, result.session, broken, now);
  if (!can || !broken.empty()) {
    on_result_of(*x, result, now, false, {});
    return;
  }
  auto judged = x->judge->judge(result.what, newest_, now);
  assert(!(judged.refused && judged.useless));
  if (judged.refused || judged.useless) {
    trace_.add(step::left_out, result.session, now,
               judged.refused ? "refused" : "useless", result.cycle);
    port_.record(messages::cycle_record{.session = result.session,
                                        .cycle = result.cycle,
                                        .created = result.created,
                                        .received = now,
                                        .interarrival = {},
                                        .doubt = result.doubt,
                                        .timing = result.timing});
  }
  if (judged.refused)
    refuse(result.session, *judged.refused, now);
  else if (judged.useless)
    leave_out(*x, *judged.useless, now);
  else if (!judged.what.empty())
    on_result_of(*x,
                 {result.session, result.cycle, result.created,
                  std::move(judged.what), result.about, result.doubt,
                  result.timing},
                 now, true, judged.margins);
}

/// @returns the limit that a result does not keep, in words; empty if it keeps
/// all.
std::string
source_selector::broken_limit(const messages::service_result& result,
                              time_point now) const {
  if (!limits_)
    return "the scene allows for none";
  if (!in_time(result.created, now, limits_->max_latency))
    return in_words("latency", now - result.created, limits_->max_latency);
  const auto& input_at = result.timing.input_at;
  if (!in_time(input_at, now, limits_->max_input_age))
    return in_words("input_age", now - input_at, limits_->max_input_age);
  return {};
}

void source_selector::note(messages::event_type what,
                           const messages::session_id& session,
                           std::string detail, time_point now) {
  port_.record(messages::event_record{.at = now,
                                      .what = what,
                                      .station = setup_.station,
                                      .provider = session.provider,
                                      .service = setup_.service.name,
                                      .counter = session.counter,
                                      .detail = std::move(detail)});
}

/// Of what may be wrong with result after result: once in a while.
/// @param last  When it was recorded last.
void source_selector::record_now_and_then(std::optional<time_point>& last,
                                          const messages::session_id& session,
                                          std::string why, time_point now) {
  if (last && now - *last < protocol::unknown_result_period)
    return;
  last = now;
  note(messages::event_type::result_refused, session, std::move(why), now);
}

/// A latency is not judged by a clock that is not known well enough: results
/// are then as good as none.
bool source_selector::can_judge(source& x,
                                const messages::service_result& result,
                                time_point now) {
  assert(result.session == x.session);
  assert(result.cycle == x.last_cycle);
  const auto can = result.doubt <= least_latency(options()) / 2;
  if (can == x.in_doubt) {
    x.in_doubt = !can;
    note(can ? messages::event_type::clock_known
             : messages::event_type::clock_in_doubt,
         result.session, in_ms(result.doubt), now);
  }
  assert(x.in_doubt == !can);
  return can;
}

/// The session of an implausible result ends in the same turn.
void source_selector::refuse(const messages::session_id& session,
                             const objection& why, time_point now) {
  on_end(
      {session, messages::end_reason::implausible, messages::side::requester},
      now);
  assert(!find(session));
  auto found = told(why);
  port_.report({session, messages::qos_breach::implausible, now, true,
                std::move(found.why), std::move(found.check)});
}

void source_selector::leave_out(source& x, const objection& why,
                                time_point now) {
  x.useless = told(why);
  note(messages::event_type::result_refused, x.session, x.useless->why, now);
  port_.watch_useless(x.session, *x.useless);
}

/// @param in_limits  Its age can be judged, it came in time, and nothing speaks
///                   against it.
void source_selector::on_result_of(source& x,
                                   const messages::service_result& result,
                                   time_point now, bool in_limits,
                                   std::span<const margin> margins) {
  assert(result.session == x.session);
  assert(result.cycle == x.last_cycle);
  assert(!in_limits || !x.in_doubt);
  assert(in_limits || margins.empty());
  if (in_limits && !is_standby(x) && result.created > began_)
    await_cycle_after(result.created);
  const auto used = in_use();
  const auto alone = used == 0 || (x.in_use && used == 1);
  const auto fits = in_limits && (alone || may_follow(result, now));
  // A standby answers the cycle that it was called for.
  const auto start = is_standby(x) ? began_ : result.created;
  const auto first = fits && answers_.use(start);
  const auto usable = fits && (alone || first);
  assert(in_limits || !usable);
  record_cycle(x, result, now, usable, margins);
  if (is_standby(x))
    x.last_received.reset();
  else if (x.in_use || in_limits)
    x.last_received = now;
  if (in_limits) {
    x.last_in_time = now;
    x.useless.reset();
    x.calls_in_vain = 0;
  }
  if (x.in_use && alone && !x.in_doubt)
    port_.watch_arrival(
        {watched_, result.created, now, result.timing.input_at});
  else if (is_remote() && usable)
    // The gap between results that are used is what counts; one that is late
    // harms nothing.
    port_.watch_arrival({watched_, now, now, now});
  if (!x.in_use && in_limits)
    begin(x, now);
  assert(x.in_use || !usable);
  if (usable)
    use(result, now);
  if (in_use() > 1)
    give_up_silent(now);
  // Who answers a call twice has not heard that it stands by.
  if (is_standby(x) && ++x.answers > 1 && input_due(x, now))
    feed(x, now);
  assert(is_consistent());
}

void source_selector::record_cycle(const source& x,
                                   const messages::service_result& result,
                                   time_point now, bool used,
                                   std::span<const margin> margins) {
  assert(!x.last_received || *x.last_received <= now);
  assert(!used || result.created <= now);
  std::optional<duration> gap; // only while in use every period
  if (x.last_received)
    gap = now - *x.last_received;
  messages::cycle_record record{.session = result.session,
                                .cycle = result.cycle,
                                .created = result.created,
                                .received = now,
                                .interarrival = gap,
                                .used = used,
                                .doubt = result.doubt,
                                .timing = result.timing};
  if (used && setup_.record_margins)
    for (const auto& m : margins)
      record.margins.push_back({std::string{m.name}, m.left});
  port_.record(std::move(record));
}

/// Two providers may disagree: results of one source are used as long as it
/// goes on.
bool source_selector::may_follow(const messages::service_result& result,
                                 time_point now) const {
  return result.session == used_from_
         || now - used_at_ > patience_periods * options().period
         || own().continues(newest_.in_use, result.what, now);
}

void source_selector::use(const messages::service_result& result,
                          time_point now) {
  assert(result.session.is_remote() == is_remote());
  assert(!is_remote() || find(result.session)->in_use);
  assert(!is_remote() || broken_limit(result, now).empty());
  trace_.add(step::used, result.session, now, {}, result.cycle);
  work_.on_board += !result.session.is_remote();
  newest_.in_use = result.what;
  used_from_ = result.session;
  used_at_ = now;
  used_input_at_ = result.timing.input_at;
  port_.use(result);
  if (!is_remote() || !warm_.is_on())
    return;
  warm_.on_used(result.created, used_input_at_, now);
  if (missing_timer_ == 0)
    await_missed_result();
}

void source_selector::record_work() {
  work_.at = now_;
  if (!work_.is_empty())
    port_.record(messages::work_record{work_});
  const auto since = work_.at;
  work_ = {setup_.station, setup_.service.name};
  work_.since = since;
}

// -- from one source to another -----------------------------------------------

void source_selector::begin(source& x, time_point now) {
  assert(!x.in_use);
  const auto was_remote = is_remote();
  x.in_use = true;
  trace_.add(step::first_data, x.session, now);
  if (!was_remote) {
    record_work();
    port_.go_remote();
    warm_.begin(now);
    watch(x.session, now);
    trace_.add(step::source, x.session, now);
    port_.announce_source(true);
  }
  port_.report_first_data(x.session);
  announce_roles(now);
  assert(is_consistent());
}

void source_selector::watch(const messages::session_id& session,
                            time_point last) {
  assert(find(session)->in_use);
  assert(last <= now_);
  watched_ = session;
  trace_.add(step::watched, session, now_);
  port_.watch(session, last);
}

void source_selector::on_end(const messages::service_end& end, time_point now) {
  pass(now);
  const auto* ended = find(end.session);
  if (!ended)
    return;
  trace_.add(step::end_got, end, now);
  const auto was_in_use = ended->in_use;
  std::erase_if(sources_,
                [&](const source& x) { return x.session == end.session; });
  assert(!find(end.session));
  if (!was_in_use)
    return;
  if (!is_remote()) {
    come_home(end, now);
    assert(is_consistent());
    return;
  }
  announce_roles(now);
  if (watched_ == end.session) {
    const auto next = std::ranges::find_if(sources_, [this](const source& x) {
      return x.in_use && !is_standby(x);
    });
    assert(next != sources_.end());
    watch(next->session, used_at_);
  }
  assert(is_consistent());
}

} // namespace sofof::offloading
