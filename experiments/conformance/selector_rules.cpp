// One function for each kind of step.
#include "experiments/conformance/selector_rules.hpp"

#include "experiments/conformance/names.hpp"

#include <algorithm>

namespace sofof::experiments::conformance {

namespace {

constexpr std::string_view one_source = "S1 results come from one source";
constexpr std::string_view home_at_once =
    "S2 the own function goes on at once, after the last provider";
constexpr std::string_view is_watched = "S3 a remote source is watched";
constexpr std::string_view running = "S4 only what runs is used";

const std::string to_remote = "source remote";
const std::string to_local = "source local";
const std::string to_watch = "the watchdog watches";

} // namespace

void selector_rules::refute(std::string_view rule, std::string what) {
  found_({std::string{rule}, std::move(what), at_});
}

bool selector_rules::any_in_use() const {
  return std::ranges::any_of(sessions_,
                             [](const auto& x) { return x.second.in_use; });
}

void selector_rules::add(const step& x, trace_place at) {
  using enum messages::trace_step;
  at_ = at;
  duties_.pass(x.at);
  switch (x.what) {
    case begun:
      return on_begun(x);
    case first_data:
      return on_first_data(x);
    case used:
      return on_used(x);
    case watched:
      return on_watched(x);
    case unwatched:
      watched_.reset();
      return;
    case source:
      return on_source(x);
    case end_got:
      return on_end(x);
    default:
      return;
  }
}

void selector_rules::on_begun(const step& x) {
  if (!sessions_.try_emplace({x.provider, x.services.front().counter}).second)
    refute("S5 a session begins once", session_in(x));
}

void selector_rules::on_first_data(const step& x) {
  const auto known = sessions_.find({x.provider, x.services.front().counter});
  if (known == sessions_.end()) {
    refute(running, session_in(x));
    return;
  }
  known->second.in_use = true;
  if (!is_remote_) {
    duties_.owe(to_remote, x.at, one_source, at_);
    duties_.owe(to_watch, x.at, is_watched, at_);
  }
}

void selector_rules::on_used(const step& x) {
  const auto is_own = x.services.front().counter == 0;
  if (is_own == is_remote_)
    refute(one_source, is_own ? "a result of the own function while remote"
                              : session_in(x) + " while local");
  if (is_own)
    return;
  const auto known = sessions_.find({x.provider, x.services.front().counter});
  if (known == sessions_.end() || !known->second.in_use) {
    refute(running, session_in(x));
    return;
  }
  if (!watched_)
    refute(is_watched, session_in(x));
  auto& last = known->second.last_cycle;
  if (last && x.number <= *last)
    refute(
        "S6 results are used in order",
        fmt::format("cycle {} after {} of {}", x.number, *last, session_in(x)));
  last = x.number;
}

void selector_rules::on_watched(const step& x) {
  const key by{x.provider, x.services.front().counter};
  const auto known = sessions_.find(by);
  if (known == sessions_.end() || !known->second.in_use)
    refute(is_watched, "by the name of " + session_in(x));
  watched_ = by;
  duties_.settle(to_watch);
}

void selector_rules::on_source(const step& x) {
  const auto remote = x.services.front().counter != 0;
  if (remote == is_remote_)
    refute(one_source, "a source that is in use already");
  if (remote != any_in_use())
    refute(home_at_once, remote
                             ? "remote, though no provider's results are in use"
                             : "local, though a provider's results are in use");
  is_remote_ = remote;
  duties_.settle(remote ? to_remote : to_local);
}

void selector_rules::on_end(const step& x) {
  const key ended{x.provider, x.services.front().counter};
  const auto known = sessions_.find(ended);
  if (known == sessions_.end())
    return;
  const auto was_in_use = known->second.in_use;
  sessions_.erase(known);
  if (!was_in_use)
    return;
  if (!any_in_use())
    duties_.owe(to_local, x.at, home_at_once, at_);
  else if (watched_ == ended)
    duties_.owe(to_watch, x.at, is_watched, at_);
  if (watched_ == ended)
    watched_.reset();
}

} // namespace sofof::experiments::conformance
