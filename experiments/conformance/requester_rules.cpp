// One function for each kind of step.
#include "experiments/conformance/requester_rules.hpp"

#include "base/protocol.hpp"
#include "experiments/conformance/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sofof::experiments::conformance {

namespace {

using messages::end_reason;
using messages::name_of;

constexpr auto answered = rule_of("V4");
constexpr auto data_in_time = rule_of("V7");
constexpr auto closed_at_once = rule_of("V8");
constexpr auto provider_told = rule_of("V9");
constexpr auto late_answer = rule_of("V6");
constexpr auto unknown_result = rule_of("V10");
constexpr auto unknown_named = rule_of("V11");
constexpr auto started_again = rule_of("V18");

std::string forgetting(provider_id id) {
  return fmt::format("forgetting provider {}", id);
}
std::string request_of(provider_id id) {
  return fmt::format("the answer of provider {}", id);
}
std::string data_of(const std::string& session) {
  return "first data, or the end, of " + session;
}

} // namespace

void requester_rules::refute(rule broken, std::string what) {
  found_({broken, std::move(what), at_});
}

requester_rules::session* requester_rules::find(const step& x) {
  const auto from = providers_.find(x.provider);
  if (from == providers_.end() || x.services.empty())
    return nullptr;
  const auto i = from->second.sessions.find(x.services.front().name);
  return i != from->second.sessions.end()
                 && i->second.counter == x.services.front().counter
             ? &i->second
             : nullptr;
}

// What has to be closed may be closed for that, in this instant.
void requester_rules::must_close(const step& x,
                                 const messages::traced_service& what,
                                 session& known,
                                 std::initializer_list<std::string_view> why) {
  for (const auto reason : why)
    known.may_end.insert_or_assign(std::string{reason}, x.at);
  duties_.owe(end_of(session_in(x.provider, x.station, what)), x.at,
              closed_at_once, at_);
}

void requester_rules::must_end(const step& x,
                               const messages::traced_service& what,
                               rule owed_by) {
  duties_.owe(end_to(session_in(x.provider, x.station, what)), x.at, owed_by,
              at_);
}

void requester_rules::add(const step& x, trace_place at) {
  using enum messages::trace_step;
  at_ = at;
  duties_.pass(x.at);
  switch (x.what) {
    case met:
      return on_met(x);
    case forgotten:
      return on_forgotten(x);
    case offer_got:
      return on_offer(x);
    case request_sent:
      return on_request(x);
    case request_over:
      return on_request_over(x);
    case response_got:
      return on_response(x);
    case begun:
      return on_begun(x);
    case first_data:
      return on_first_data(x);
    case digest_got:
      return on_digest(x);
    case result_refused:
      return on_unknown_result(x);
    case violation:
      return on_violation(x);
    case end_got:
      return on_end_got(x);
    case end_sent:
      return on_end_sent(x);
    case closed:
      return on_closed(x);
    case peer_lost:
      return on_lost(x);
    case shut_down:
      return on_shut_down(x);
    default:
      return;
  }
}

// A peer that speaks for another provider now has started again; what still
// runs there ends by itself.
void requester_rules::on_met(const step& x) {
  for (const auto& [id, known] : providers_)
    if (id != x.provider && known.peer == x.number && !known.open_request
        && known.sessions.empty())
      duties_.owe(forgetting(id), x.at, started_again, at_);
  providers_[x.provider].peer = x.number;
}

void requester_rules::on_forgotten(const step& x) {
  if (!duties_.is_owed(forgetting(x.provider)))
    refute(started_again, fmt::format("provider {}", x.provider));
  duties_.settle(forgetting(x.provider));
  on_lost(x);
}

void requester_rules::on_offer(const step& x) {
  auto& from = providers_[x.provider];
  from.is_lost = false;
  from.offered.clear();
  for (const auto& s : x.services)
    from.offered[s.name] = x.at;
}

void requester_rules::on_request(const step& x) {
  auto& to = providers_[x.provider];
  if (x.number != last_request_ + 1)
    refute(rule_of("V1"), fmt::format("{} after {}", x.number, last_request_));
  last_request_ = x.number;
  if (to.open_request)
    refute(rule_of("V2"),
           fmt::format("{} while {} is open", x.number, *to.open_request));
  for (const auto& [name, counter] : x.services) {
    const auto offer = to.offered.find(name);
    if (offer == to.offered.end()
        || x.at - offer->second > protocol::offer_validity)
      refute(rule_of("V3"),
             fmt::format("{} of provider {}", name.view(), x.provider));
    if (to.sessions.contains(name))
      refute(rule_of("V3"),
             fmt::format("{} runs at provider {}", name.view(), x.provider));
    const auto cools = to.cools_until.find(name);
    if (cools != to.cools_until.end() && x.at + slack_ < cools->second)
      refute(rule_of("V5"),
             fmt::format("{} of provider {}", name.view(), x.provider));
    judge_others(x, name);
    to.offered.erase(name);
    to.requested.insert(name);
    own_.insert(name);
  }
  to.open_request = x.number;
  to.asked = x.at;
  duties_.owe(request_of(x.provider), x.at + protocol::request_timeout,
              answered, at_);
}

// One decision may be for two providers.
void requester_rules::judge_others(const step& x, const service& name) {
  for (const auto& [id, other] : providers_) {
    const auto runs = other.sessions.find(name);
    const auto is_asked = other.open_request && other.requested.contains(name)
                          && other.asked != x.at;
    const auto starts = runs != other.sessions.end() && !runs->second.is_remote;
    if (id != x.provider && (is_asked || starts))
      refute(rule_of("V19"),
             fmt::format("{} of provider {}, while it {} provider {}",
                         name.view(), x.provider,
                         starts ? "starts at" : "is asked for of", id));
  }
}

void requester_rules::on_request_over(const step& x) {
  auto& from = providers_[x.provider];
  if (from.open_request != x.number)
    refute(answered, fmt::format("request {} was not open", x.number));
  else if (x.at < from.asked + protocol::request_timeout)
    refute(answered, fmt::format("request {} was given up early", x.number));
  from.open_request.reset();
  from.requested.clear();
  duties_.settle(request_of(x.provider));
}

void requester_rules::on_response(const step& x) {
  const auto known = providers_.find(x.provider);
  if (known == providers_.end() || known->second.is_lost)
    return; // it cannot be told anything
  auto& from = known->second;
  from.accepted.clear();
  if (from.open_request != x.number) {
    for (const auto& what : x.services) {
      const auto runs = from.sessions.find(what.name);
      if (what.counter != 0
          && (runs == from.sessions.end()
              || runs->second.counter != what.counter)) // no mere duplicate
        must_end(x, what, late_answer);
    }
    return;
  }
  from.open_request.reset();
  duties_.settle(request_of(x.provider));
  for (const auto& what : x.services)
    if (what.counter != 0 && from.requested.contains(what.name))
      from.accepted.try_emplace(what.name, what.counter);
  from.requested.clear();
}

void requester_rules::on_begun(const step& x) {
  auto& at = providers_[x.provider];
  const auto& [name, counter] = x.services.front();
  const auto accepted = at.accepted.find(name);
  if (accepted == at.accepted.end() || accepted->second != counter)
    refute(rule_of("V12"), session_in(x));
  if (counter <= at.last_counter)
    refute(rule_of("V13"),
           fmt::format("{} after {}", session_in(x), at.last_counter));
  if (at.sessions.contains(name))
    refute(rule_of("V12"), session_in(x) + ": another one was not closed");
  at.last_counter = counter;
  at.sessions[name] = {.counter = counter, .begun = x.at, .confirmed = x.at};
  duties_.owe(data_of(session_in(x)), x.at + protocol::start_timeout,
              data_in_time, at_);
}

void requester_rules::on_first_data(const step& x) {
  auto* known = find(x);
  if (!known || known->is_remote)
    refute(rule_of("V14"), session_in(x));
  else
    known->is_remote = true;
  duties_.settle(data_of(session_in(x)));
}

void requester_rules::on_digest(const step& x) {
  auto& from = providers_[x.provider];
  judge_unnamed(from, x);
  if (from.open_request || from.is_lost
      || (from.corrected
          && x.at - *from.corrected < protocol::unknown_result_period))
    return;
  for (const auto& name : own_) {
    const auto named =
        std::ranges::find(x.services, name, &messages::traced_service::name);
    if (named == x.services.end())
      continue;
    const auto known = from.sessions.find(name);
    if (known != from.sessions.end() && known->second.counter == named->counter)
      continue;
    must_end(x, *named, unknown_named);
    from.corrected = x.at;
  }
}

// A decision may come at an epoch of the policy, which is no step, and end what
// is in use; what starts ends when the scene is not safe under it any more,
// which is no step either. Results that came late for use are no step either:
// they may have confirmed a session, but never make it end.
bool requester_rules::may_close(const step& x, const session& known) const {
  if (is_for(x, end_reason::no_data)
      && ((!known.is_remote && x.at >= known.begun + protocol::start_timeout)
          || x.at >= known.confirmed + protocol::confirmation_timeout))
    return true;
  if (is_for(x, end_reason::released))
    return true;
  if (is_for(x, end_reason::handed_over))
    return known.is_remote
           && std::ranges::any_of(providers_, [&](const auto& other) {
                const auto i =
                    other.second.sessions.find(x.services.front().name);
                return other.first != x.provider
                       && i != other.second.sessions.end()
                       && i->second.is_remote;
              });
  return is_given(x, known.may_end);
}

// A session that two digests do not name is over.
void requester_rules::judge_unnamed(provider& from, const step& x) {
  for (auto& [name, s] : from.sessions) {
    if (s.counter > x.number)
      continue;
    const messages::traced_service what{name, s.counter};
    if (std::ranges::count(x.services, what) > 0) {
      s.unnamed_since.reset();
      s.confirmed = x.at;
    } else if (!s.unnamed_since) {
      s.unnamed_since = x.at;
    } else if (x.at - *s.unnamed_since >= protocol::digest_period / 2) {
      s.untold = true;
      must_close(x, what, s, {name_of(end_reason::no_data)});
    }
  }
}

void requester_rules::on_unknown_result(const step& x) {
  const auto from = providers_.find(x.provider);
  if (find(x))
    refute(rule_of("V15"), session_in(x));
  if (from == providers_.end() || from->second.is_lost)
    return;
  auto& last = from->second.complained;
  if (last && x.at - *last < protocol::unknown_result_period)
    return;
  last = x.at;
  must_end(x, x.services.front(), unknown_result);
}

void requester_rules::on_violation(const step& x) {
  if (auto* known = find(x))
    must_close(
        x, x.services.front(), *known,
        {name_of(end_reason::qos_latency), name_of(end_reason::qos_input_age),
         name_of(end_reason::qos_gap), name_of(end_reason::implausible)});
}

void requester_rules::on_end_got(const step& x) {
  auto* known = find(x);
  if (!known)
    return;
  known->untold = true;
  must_close(x, x.services.front(), *known, {x.detail});
}

void requester_rules::on_end_sent(const step& x) {
  if (find(x))
    refute(rule_of("V16"), session_in(x));
  duties_.settle(end_to(session_in(x)));
}

void requester_rules::on_closed(const step& x) {
  auto* known = find(x);
  if (!known) {
    refute(rule_of("V17"), session_in(x));
    return;
  }
  if (!may_close(x, *known))
    refute(rule_of("V20"), fmt::format("{} as {}", session_in(x), x.detail));
  if (!known->untold)
    must_end(x, x.services.front(), provider_told);
  auto& from = providers_[x.provider];
  from.sessions.erase(x.services.front().name);
  duties_.settle(end_of(session_in(x)));
  duties_.settle(data_of(session_in(x)));
  if (!is_planned(x.detail))
    from.cools_until[x.services.front().name] = x.at + protocol::cool_down;
}

void requester_rules::on_lost(const step& x) {
  auto& lost = providers_[x.provider];
  lost.is_lost = true;
  lost.peer.reset();
  lost.open_request.reset();
  lost.requested.clear();
  lost.offered.clear();
  duties_.settle(request_of(x.provider));
  for (auto& [name, s] : lost.sessions) {
    s.untold = true;
    must_close(x, {name, s.counter}, s, {name_of(end_reason::peer_lost)});
  }
}

void requester_rules::on_shut_down(const step& x) {
  duties_.drop_all();
  has_ended_ = true;
  auto of = x;
  for (auto& [id, from] : providers_) {
    of.provider = id;
    for (auto& [name, s] : from.sessions)
      must_close(of, {name, s.counter}, s, {name_of(end_reason::shutdown)});
  }
}

void requester_rules::finish() {
  if (has_ended_)
    duties_.pass(time_point::max());
}

} // namespace sofof::experiments::conformance
