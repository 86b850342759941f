// Deaths are found when it is looked at, or given something.
#include "base/process/kept_program.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof {

namespace {

std::int64_t in_ns(time_point t) {
  return t.time_since_epoch().count();
}

/// What a program has to end itself, and after it was asked to.
constexpr std::chrono::milliseconds grace{200};

} // namespace

std::unique_ptr<framed_program> start_program(const kept_setup& setup) {
  return std::make_unique<framed_program>(setup.how, setup.configuration,
                                          setup.most_octets);
}

kept_program::kept_program(kept_setup setup,
                           std::function<void(program_news)> on_news)
    : setup_{std::move(setup)}, on_news_{std::move(on_news)},
      pause_{setup_.first_pause} {
  assert(setup_.answer_limit.count() > 0 && setup_.start_limit.count() > 0);
  assert(setup_.first_pause > duration{0});
}

void kept_program::configure(time_point now) {
  is_kept_ = true;
  start(now);
}

void kept_program::activate(time_point now) {
  is_active_ = true;
  if (runs_)
    runs_->tell(frame_kind::activate, in_ns(now), setup_.activation);
}

void kept_program::deactivate(time_point now) {
  is_active_ = false;
  if (runs_)
    runs_->tell(frame_kind::deactivate, in_ns(now));
}

void kept_program::shut_down(time_point now) {
  is_kept_ = false;
  if (const auto last = std::exchange(runs_, nullptr))
    last->shut_down(in_ns(now), grace);
}

void kept_program::look(time_point now) {
  is_up(now, framed_program::clock::now());
}

std::optional<std::vector<std::byte>>
kept_program::exchange(time_point now, std::span<const std::byte> input) {
  using clock = framed_program::clock;
  const auto until =
      setup_.waits_for_start ? clock::now() + setup_.start_limit : clock::now();
  if (!is_up(now, until))
    return std::nullopt;
  auto result = runs_->exchange(in_ns(now), ++inputs_, input,
                                clock::now() + setup_.answer_limit);
  if (result)
    pause_ = setup_.first_pause;
  else
    note_death(now);
  return result;
}

std::optional<pid_t> kept_program::id() const {
  return runs_ ? std::optional{runs_->id()} : std::nullopt;
}

void kept_program::start(time_point now) {
  assert(is_kept_ && !runs_);
  is_ready_ = false;
  inputs_ = 0;
  try {
    if (setup_.take_started)
      runs_ = setup_.take_started();
    if (!runs_)
      runs_ = start_program(setup_);
  } catch (const input_error& problem) {
    return lose(now, problem.what());
  }
  ready_by_ = framed_program::clock::now() + setup_.start_limit;
  if (is_active_)
    runs_->tell(frame_kind::activate, in_ns(now), setup_.activation);
}

/// @param until  So long it may take to be ready.
bool kept_program::is_up(time_point now,
                         framed_program::clock::time_point until) {
  if (!is_kept_)
    return false;
  if (!runs_ && now >= again_at_)
    start(now);
  if (!runs_)
    return false;
  if (is_ready_) {
    runs_->look();
  } else if (runs_->is_ready(until)) {
    is_ready_ = true;
    ready_at_ = now;
    if (std::exchange(is_missed_, false))
      on_news_({.is_there = true, .why = {}});
  } else if (runs_->objection().empty()
             && framed_program::clock::now() >= ready_by_) {
    lose(now,
         fmt::format("was not ready after {} ms", setup_.start_limit.count()));
  }
  note_death(now);
  return runs_ && is_ready_;
}

void kept_program::note_death(time_point now) {
  if (runs_ && !runs_->objection().empty())
    lose(now, runs_->objection());
}

void kept_program::lose(time_point now, std::string why) {
  runs_.reset(); // kills what is left of it
  if (is_ready_ && now - ready_at_ >= pause_)
    pause_ = setup_.first_pause;
  again_at_ = now + pause_;
  pause_ = std::min(2 * pause_, setup_.longest_pause);
  is_missed_ = true;
  on_news_({.is_there = false, .why = std::move(why)});
}

} // namespace sofof
