// One function for each kind of step.
#include "experiments/conformance/selector_rules.hpp"

#include "experiments/conformance/names.hpp"
#include "messages/protocol/service.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::experiments::conformance {

namespace {

constexpr auto one_source = rule_of("S1");
constexpr auto home_at_once = rule_of("S2");
constexpr auto is_watched = rule_of("S3");
constexpr auto running = rule_of("S4");
constexpr auto by_its_judge = rule_of("S7");
constexpr auto called_for_others = rule_of("S8");

const std::string to_remote = "source remote";
const std::string to_local = "source local";
const std::string to_watch = "the watchdog watches";

constexpr std::string_view refused = "refused";
constexpr auto as_implausible =
    messages::name_of(messages::end_reason::implausible);
constexpr auto for_a_gap = messages::name_of(messages::end_reason::qos_gap);

} // namespace

void selector_rules::refute(rule broken, std::string what) {
  found_({broken, std::move(what), at_});
}

std::ptrdiff_t selector_rules::in_use() const {
  return std::ranges::count_if(sessions_,
                               [](const auto& x) { return x.second.in_use; });
}

selector_rules::session* selector_rules::find(const step& x) {
  const auto i = sessions_.find({x.provider, x.services.front().counter});
  return i == sessions_.end() ? nullptr : &i->second;
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
    case left_out:
      return on_left_out(x);
    case standby:
      standby_ = x.provider;
      return;
    case called:
      return on_called(x);
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
    refute(rule_of("S5"), session_in(x));
}

void selector_rules::on_first_data(const step& x) {
  auto* known = find(x);
  if (!known) {
    refute(running, session_in(x));
    return;
  }
  known->in_use = true;
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
  auto* known = find(x);
  if (!known || !known->in_use) {
    refute(running, session_in(x));
    return;
  }
  if (!watched_)
    refute(is_watched, session_in(x));
  known->used = x.at;
  useless_.reset();
  auto& last = known->last_cycle;
  if (last && x.number <= *last)
    refute(rule_of("S6"), fmt::format("cycle {} after {} of {}", x.number,
                                      *last, session_in(x)));
  last = x.number;
}

// One that is refused ends its session at once; others do if no result that is
// of use comes in time.
void selector_rules::on_left_out(const step& x) {
  auto* known = find(x);
  if (!known) {
    refute(running, session_in(x));
    return;
  }
  known->left_out = x.at;
  if (watched_ == key{x.provider, x.services.front().counter})
    useless_ = x.at;
  if (x.detail == refused)
    duties_.owe(end_of(session_in(x)), x.at, by_its_judge, at_);
}

void selector_rules::on_called(const step& x) {
  const auto* known = find(x);
  if (!known || !known->in_use || x.provider != standby_ || in_use() < 2)
    refute(called_for_others, session_in(x));
}

// What comes in the instant of the end may have come too late for it.
void selector_rules::judge_reason(const session& ended, const step& x) {
  if (x.detail == as_implausible
      && (!ended.left_out
          || (ended.used > ended.left_out && *ended.used + slack_ < x.at)))
    refute(by_its_judge, session_in(x) + ": it was not");
  if (x.detail == for_a_gap && useless_ && *useless_ + slack_ < x.at
      && in_use() == 1
      && watched_ == key{x.provider, x.services.front().counter})
    refute(by_its_judge, session_in(x) + ": it was, but ended for a gap");
}

void selector_rules::on_watched(const step& x) {
  const key by{x.provider, x.services.front().counter};
  const auto known = sessions_.find(by);
  if (known == sessions_.end() || !known->second.in_use)
    refute(is_watched, "by the name of " + session_in(x));
  watched_ = by;
  useless_.reset();
  duties_.settle(to_watch);
}

void selector_rules::on_source(const step& x) {
  const auto remote = x.services.front().counter != 0;
  if (remote == is_remote_)
    refute(one_source, "a source that is in use already");
  if (remote != (in_use() > 0))
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
  judge_reason(known->second, x);
  duties_.settle(end_of(session_in(x)));
  sessions_.erase(known);
  if (!was_in_use)
    return;
  if (in_use() == 0)
    duties_.owe(to_local, x.at, home_at_once, at_);
  else if (watched_ == ended)
    duties_.owe(to_watch, x.at, is_watched, at_);
  if (watched_ == ended)
    watched_.reset();
}

} // namespace sofof::experiments::conformance
