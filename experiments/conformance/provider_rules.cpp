// One function for each kind of step.
#include "experiments/conformance/provider_rules.hpp"

#include "base/protocol.hpp"
#include "experiments/conformance/names.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof::experiments::conformance {

namespace {

using messages::end_reason;
using messages::name_of;

constexpr auto only_heard = rule_of("P1");
constexpr auto one_answer = rule_of("P4");
constexpr auto ended_at_once = rule_of("P8");
constexpr auto vehicle_told = rule_of("P9");
constexpr auto digests = rule_of("P10");
constexpr auto silent = rule_of("P12");
constexpr auto lost = rule_of("P16");

constexpr auto for_a_reason = rule_of("P17");

constexpr std::string_view inside = "inside";
const std::string a_decision = "an answer, as sessions were revoked";

std::string response_to(const messages::trace_record& x) {
  return fmt::format("response {} to station {}", x.number, x.station);
}
std::string digest_to(station_id station) {
  return fmt::format("digest to station {}", station);
}
std::string new_requester_of(station_id station) {
  return fmt::format("a new requester of station {}", station);
}
std::string forgetting(station_id station) {
  return fmt::format("forgetting station {}", station);
}

} // namespace

void provider_rules::refute(rule broken, std::string what) {
  found_({broken, std::move(what), at_});
}

provider_rules::session* provider_rules::find(station& of, const step& x) {
  if (x.services.empty())
    return nullptr;
  const auto i = of.sessions.find(x.services.front().name);
  return i != of.sessions.end()
                 && i->second.counter == x.services.front().counter
             ? &i->second
             : nullptr;
}

void provider_rules::must_close(const step& x, const service& name,
                                session& what, std::string_view reason,
                                bool untold) {
  what.may_end.insert_or_assign(std::string{reason}, x.at);
  what.untold = what.untold || untold;
  duties_.owe(end_of(session_in(x.provider, x.station, {name, what.counter})),
              x.at, ended_at_once, at_);
}

void provider_rules::add(const step& x, trace_place at) {
  using enum messages::trace_step;
  at_ = at;
  duties_.pass(x.at);
  if (x.what == shut_down)
    return on_shut_down(x);
  if (x.what == peer_lost)
    return on_lost(x);
  auto& of = stations_[x.station];
  switch (x.what) {
    case heard:
      return on_heard(of, x);
    case met:
      return on_met(of, x);
    case offer_sent:
      return on_offer(of, x);
    case request_got:
      return on_request(of, x);
    case response_sent:
      return on_response(of, x);
    case begun:
      return on_begun(of, x);
    case digest_sent:
      return on_digest(of, x);
    case end_sent:
      return on_end_sent(of, x);
    case closed:
      return on_closed(of, x);
    case forgotten:
      return on_forgotten(of, x);
    case end_got:
    case function_lost:
      if (auto* known = find(of, x))
        must_close(x, x.services.front().name, *known, x.detail,
                   x.what == end_got);
      return;
    default:
      return;
  }
}

void provider_rules::on_heard(station& of, const step& x) {
  if (!of.is_known)
    of = {};
  of.is_known = true;
  of.heard = x.at;
  duties_.owe(forgetting(x.station), x.at + protocol::cam_timeout + duration{1},
              silent, at_);
  const auto is_inside = x.detail == inside;
  if (is_inside && !of.is_inside)
    of.may_offer = true;
  of.is_inside = is_inside;
  for (auto& [name, s] : of.sessions) {
    s.was_inside = s.was_inside || is_inside;
    if (s.was_inside && !is_inside)
      must_close(x, name, s, name_of(end_reason::left_area));
  }
}

void provider_rules::on_met(station& of, const step& x) {
  of.requester = x.number;
  of.may_offer = true;
  of.last_request = 0;
  drop_requests(x.station, of);
  duties_.settle(new_requester_of(x.station));
  for (auto& [name, s] : of.sessions)
    must_close(x, name, s, name_of(end_reason::peer_lost));
}

void provider_rules::on_offer(station& of, const step& x) {
  if (!of.is_known)
    refute(only_heard, fmt::format("an offer to station {}", x.station));
  if (of.offered && x.at - *of.offered + slack_ < protocol::offer_period
      && !of.may_offer)
    refute(rule_of("P2"), fmt::format("a second one to station {}", x.station));
  of.offered = x.at;
  of.may_offer = false;
  for (const auto& [name, counter] : x.services)
    if (of.sessions.contains(name))
      refute(rule_of("P3"),
             fmt::format("{} to station {}", name.view(), x.station));
}

// What is asked for is answered in the same instant, or at the end of an epoch.
void provider_rules::on_request(station& of, const step& x) {
  if (of.is_known && x.number <= of.last_request)
    return;
  of.last_request = of.is_known ? x.number : 0;
  drop_requests(x.station, of); // it has given those up
  auto& asked = of.open[x.number];
  for (const auto& what : x.services)
    asked.insert(what.name);
  duties_.owe(response_to(x),
              of.is_known ? x.at + protocol::request_timeout : x.at, one_answer,
              at_);
}

void provider_rules::drop_requests(station_id id, station& of) {
  for (const auto& [number, services] : of.open)
    duties_.settle(response_to({.station = id, .number = number}));
  of.open.clear();
}

void provider_rules::on_response(station& of, const step& x) {
  const auto open = of.open.find(x.number);
  if (open == of.open.end() && !x.services.empty())
    refute(one_answer,
           fmt::format("request {} of station {}", x.number, x.station));
  for (const auto& what : x.services) {
    const auto runs = of.sessions.find(what.name);
    if (what.counter != 0
        && (runs == of.sessions.end() || runs->second.counter != what.counter))
      refute(rule_of("P5"), session_in(x.provider, x.station, what));
  }
  if (open != of.open.end())
    of.open.erase(open);
  duties_.settle(response_to(x));
  duties_.settle(a_decision);
}

void provider_rules::on_begun(station& of, const step& x) {
  const auto& [name, counter] = x.services.front();
  const auto asked = std::ranges::any_of(of.open, [&](const auto& request) {
    return request.second.contains(name);
  });
  if (!of.is_known)
    refute(only_heard, session_in(x));
  if (!asked)
    refute(rule_of("P6"), session_in(x));
  if (counter != last_counter_ + 1)
    refute(rule_of("P7"),
           fmt::format("{} after {}", session_in(x), last_counter_));
  if (of.sessions.contains(name))
    refute(rule_of("P6"), session_in(x) + ": another one runs");
  last_counter_ = counter;
  of.sessions[name] = {.counter = counter,
                       .was_inside = of.is_inside || x.detail == inside};
  if (!of.open.empty())
    duties_.owe(
        response_to({.station = x.station, .number = of.open.begin()->first}),
        x.at, rule_of("P5"), at_);
  if (!of.digest_due)
    await_digest(of, x);
}

void provider_rules::await_digest(station& of, const step& x) {
  of.digest_due = x.at + protocol::digest_period;
  duties_.owe(digest_to(x.station), *of.digest_due, digests, at_);
}

void provider_rules::on_digest(station& of, const step& x) {
  if (!of.digest_due || x.at < *of.digest_due)
    refute(digests, fmt::format("one to station {} too early", x.station));
  if (x.number != last_counter_)
    refute(rule_of("P11"), fmt::format("its last counter is {}, not {}",
                                       x.number, last_counter_));
  auto named = of.sessions.size() == x.services.size();
  for (const auto& what : x.services) {
    const auto runs = of.sessions.find(what.name);
    named = named && runs != of.sessions.end()
            && runs->second.counter == what.counter;
  }
  if (!named)
    refute(rule_of("P11"),
           fmt::format("it names {} sessions of station {}, where {} run",
                       x.services.size(), x.station, of.sessions.size()));
  of.digest_due.reset();
  duties_.settle(digest_to(x.station));
  if (!of.sessions.empty() || x.at < of.told_until)
    await_digest(of, x);
}

void provider_rules::on_end_sent(station& of, const step& x) {
  if (find(of, x))
    refute(rule_of("P13"), session_in(x));
  duties_.settle(end_to(session_in(x)));
}

// A new requester is met, and a decision is told, when what they end has been
// closed. What a station asks for anew does not run there.
void provider_rules::judge_reason(const station& of, const session& known,
                                  const step& x) {
  if (is_given(x, known.may_end))
    return;
  if (is_for(x, end_reason::peer_lost))
    return duties_.owe(new_requester_of(x.station), x.at, for_a_reason, at_);
  if (is_for(x, end_reason::revoked))
    return duties_.owe(a_decision, x.at, for_a_reason, at_);
  if (is_for(x, end_reason::no_data))
    for (const auto& [number, services] : of.open)
      if (services.contains(x.services.front().name))
        return duties_.owe(
            response_to({.station = x.station, .number = number}), x.at,
            for_a_reason, at_);
  refute(for_a_reason, fmt::format("{} as {}", session_in(x), x.detail));
}

void provider_rules::on_closed(station& of, const step& x) {
  const auto* known = find(of, x);
  if (!known) {
    refute(rule_of("P14"), session_in(x));
    return;
  }
  judge_reason(of, *known, x);
  if (!known->untold)
    duties_.owe(end_to(session_in(x)), x.at, vehicle_told, at_);
  if (is_for(x, end_reason::left_area) && of.is_inside)
    refute(rule_of("P15"), session_in(x));
  of.sessions.erase(x.services.front().name);
  of.told_until = x.at + protocol::digest_goes_on;
  duties_.settle(end_of(session_in(x)));
}

void provider_rules::on_forgotten(station& of, const step& x) {
  const auto is_silent = is_for(x, end_reason::cam_timeout);
  if (!is_silent && !is_given(x, of.may_go))
    refute(for_a_reason,
           fmt::format("station {} was forgotten as {}", x.station, x.detail));
  if (is_silent && x.at - of.heard <= protocol::cam_timeout)
    refute(silent, fmt::format("station {} was heard {:.3f} s before",
                               x.station, to_seconds(x.at - of.heard)));
  duties_.settle(forgetting(x.station));
  duties_.settle(digest_to(x.station));
  of.is_known = false;
  of.digest_due.reset();
  drop_requests(x.station, of);
  for (auto& [name, s] : of.sessions)
    must_close(x, name, s, x.detail);
}

void provider_rules::on_lost(const step& x) {
  for (auto& [id, of] : stations_)
    if (of.is_known && of.requester == x.number) {
      of.may_go.insert_or_assign(x.detail, x.at);
      duties_.owe(forgetting(id), x.at, lost, at_);
    }
}

void provider_rules::on_shut_down(const step& x) {
  duties_.drop_all();
  for (auto& [id, of] : stations_)
    of.may_go.insert_or_assign(std::string{name_of(end_reason::shutdown)},
                               x.at);
  has_ended_ = true;
}

void provider_rules::finish() {
  if (!has_ended_)
    return;
  duties_.pass(time_point::max());
  for (const auto& [id, of] : stations_)
    for (const auto& [name, s] : of.sessions)
      refute(ended_at_once, fmt::format("{}#{} of station {} at the end",
                                        name.view(), s.counter, id));
}

} // namespace sofof::experiments::conformance
