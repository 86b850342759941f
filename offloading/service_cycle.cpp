// A cycle is run on its grid, at activation, or at every call.
#include "offloading/service_cycle.hpp"

#include "base/random_phase.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::offloading {

namespace {

// More cycles ahead of the grid for inputs that say `at_once`: two services
// before it may come home at one moment.
constexpr std::uint64_t most_besides = 2;

// @returns the first moment after `t` on the grid phase + k · period.
time_point next_on_grid(time_point t, duration phase, duration period) {
  const auto since = t.time_since_epoch() - phase;
  auto k = since / period;
  if (since >= duration{0})
    ++k;
  const time_point next{phase + k * period};
  assert(next > t && next - t <= period);
  return next;
}

} // namespace

cycle_setup own_cycle(const onboard_service& service, station_id vehicle,
                      const random_stream& noise) {
  assert(service.own);
  const auto period = service.options.period;
  assert(period > duration{0});
  const auto drawn = noise.part(service.name.view()).part("local phase");
  return {.session = {0, vehicle, service.name, 0},
          .function = service.own->make_function(),
          .period = period,
          .phase = random_phase(drawn, period),
          .finish = {},
          .per_input = service.options.per_input};
}

void cycle_port::deliver_at(time_point t, coming_result result) {
  if (auto made = result.take())
    deliver_at(t, std::move(*made));
}

service_cycle::service_cycle(cycle_setup setup, cycle_port& port)
    : setup_{std::move(setup)}, port_{port} {
  assert(setup_.function);
  assert(setup_.finish);
  assert(setup_.period > duration{0});
  assert(setup_.phase >= duration{0} && setup_.phase < setup_.period);
}

service_cycle::~service_cycle() {
  try {
    end_last();
  } catch (...) {
    return; // who ends has no use for it
  }
}

void service_cycle::on_step(messages::lifecycle_step step, time_point now) {
  const auto next = messages::after(state_, step);
  if (!next)
    return;
  state_ = *next;
  stop_timer();
  if (state_ == messages::lifecycle_state::finalized)
    end_last();
  assert(setup_.function);
  setup_.function->on_step(step, now);
  if (state_ == messages::lifecycle_state::active)
    begin(now);
  assert(is_consistent());
}

void service_cycle::on_input(const messages::service_input& input,
                             time_point now) {
  if (input.at < newest_.at)
    return; // overtaken on its way
  newest_ = input;
  assert(newest_.at == input.at);
  if (waits_for_input())
    stop_timer();
  if (state_ != messages::lifecycle_state::active) {
    end_last();
    setup_.function->observe(now, newest_);
  } else if (!has_timer_)
    begin(now);
  else if (input.at_once)
    run(now, true);
  assert(is_consistent());
}

void service_cycle::on_timer(std::uint64_t number, time_point now) {
  assert(number <= timer_);
  if (number == completion)
    return look_after(now);
  if (number != timer_)
    return;
  assert(state_ == messages::lifecycle_state::active);
  await_next(now);
  run(now);
  assert(is_consistent());
}

// While the cycle is active a timer is under way, unless it waits for inputs.
bool service_cycle::is_consistent() const {
  const auto is_active = state_ == messages::lifecycle_state::active;
  return has_timer_ == (is_active && !waits_for_input())
         && (!is_due_ || (under_way_ && is_active));
}

bool service_cycle::waits_for_input() const {
  return setup_.per_input || newest_.standby;
}

void service_cycle::begin(time_point now) {
  assert(state_ == messages::lifecycle_state::active);
  assert(!has_timer_);
  if (waits_for_input()) {
    run(now, newest_.at_once);
    return;
  }
  await_next(now);
  if (!setup_.keeps_phase)
    run(now);
}

void service_cycle::stop_timer() {
  ++timer_;
  has_timer_ = false;
  is_due_ = is_due_besides_ = false;
}

void service_cycle::await_next(time_point now) {
  has_timer_ = true;
  port_.wake_at(next_on_grid(now, setup_.phase, setup_.period), timer_);
}

void service_cycle::run(time_point now, bool is_besides) {
  assert(state_ == messages::lifecycle_state::active);
  const auto is_called = is_besides || waits_for_input();
  if (under_way_) {
    is_due_ = true;
    is_due_besides_ = is_due_besides_ || is_besides;
    return;
  }
  const auto on_grid = grid_number(now);
  // A call off the grid may run one cycle more than the grid has by then.
  const auto cycle =
      std::max(on_grid, is_called ? after_any_ : after_off_grid_);
  assert(cycle >= on_grid);
  const auto is_ahead = cycle > on_grid + 1 + (is_besides ? most_besides : 0);
  if (newest_.what.empty() || is_ahead)
    return;
  end_last();
  auto begun = setup_.function->begin(now, newest_);
  if (auto* left = std::get_if<std::function<service_output()>>(&begun);
      left && !setup_.pool)
    begun = (*left)();
  const auto* made = std::get_if<service_output>(&begun);
  if (made && made->what.empty())
    return;
  assert(cycle >= after_any_ || !is_called);
  after_any_ = cycle + 1;
  if (is_called || cycle > on_grid)
    after_off_grid_ = after_any_;
  assert(after_off_grid_ <= after_any_);
  coming_result result;
  result.frame.session = setup_.session;
  result.frame.cycle = cycle;
  result.frame.created = setup_.per_input ? newest_.at : now;
  compute(std::move(begun), result);
  const auto work = setup_.finish(now, cycle);
  assert(work.computing >= duration{0});
  assert(work.done - work.computing >= now);
  result.frame.timing = {.input_at = newest_.at,
                         .up = newest_.up,
                         .queue = work.done - work.computing - now,
                         .computing = work.computing};
  if (setup_.review) {
    under_way_ = std::move(result);
    begun_ = now;
    port_.wake_at(work.done, completion);
  } else if (result.output) {
    port_.deliver_at(work.done, std::move(result));
  } else if (!result.frame.what.empty()) {
    port_.deliver_at(work.done, std::move(result.frame));
  }
}

/// The pool computes what is left of the cycle.
void service_cycle::compute(begun_cycle cycle, coming_result& result) {
  assert(!result.output && result.frame.what.empty());
  auto* left = std::get_if<std::function<service_output()>>(&cycle);
  assert(!left || setup_.pool);
  if (left && setup_.pool->has_helpers()) {
    last_ = std::make_shared<coming_output>(setup_.function, std::move(*left));
    last_->begin(*setup_.pool);
    result.output = last_;
    return;
  }
  auto made = left ? (*left)() : std::get<service_output>(std::move(cycle));
  result.frame.what = std::move(made.what);
  result.frame.about = std::move(made.about);
}

/// A function does one thing after the other, and lives no longer than on one
/// thread.
void service_cycle::end_last() const {
  if (last_)
    last_->wait();
}

/// The cycle under way is done, or something more urgent came in between.
void service_cycle::look_after(time_point now) {
  assert(under_way_);
  const auto done = setup_.review(now);
  if (done > now)
    return port_.wake_at(done, completion);
  auto& timing = under_way_->frame.timing;
  timing.queue = now - begun_ - timing.computing;
  assert(timing.queue >= duration{0});
  auto result = under_way_->take();
  under_way_.reset();
  if (result)
    port_.deliver_at(now, std::move(*result));
  const auto is_besides = std::exchange(is_due_besides_, false);
  if (std::exchange(is_due_, false))
    run(now, is_besides);
  assert(is_consistent());
}

std::uint64_t service_cycle::grid_number(time_point t) const {
  return static_cast<std::uint64_t>(
      (t.time_since_epoch() - setup_.phase + setup_.period) / setup_.period);
}

} // namespace sofof::offloading
