// From verdicts and data to the end of a session.
#include "base/protocol.hpp"
#include "messages/protocol/record.hpp"
#include "offloading/qos_monitor.hpp"
#include "offloading/requester.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace sofof::offloading {

namespace {

messages::end_reason reason_of(messages::qos_breach breach) {
  switch (breach) {
    case messages::qos_breach::latency:
      return messages::end_reason::qos_latency;
    case messages::qos_breach::input_age:
      return messages::end_reason::qos_input_age;
    case messages::qos_breach::gap:
      return messages::end_reason::qos_gap;
    case messages::qos_breach::scene:
      return messages::end_reason::released;
    case messages::qos_breach::implausible:
      break;
  }
  return messages::end_reason::implausible;
}

} // namespace

// -- verdicts -----------------------------------------------------------------

void requester::on_response(const messages::service_response& response,
                            time_point now) {
  pass(now);
  trace_.add(step::response_got, response, now);
  const auto i = providers_.find(response.provider);
  const auto expected =
      i != providers_.end() && i->second.open_request == response.number;
  if (expected)
    i->second.open_request.reset();
  const auto is_sound = [&](const messages::session_id& session) {
    return session.provider == response.provider
           && session.station == setup_.station && session.is_remote();
  };
  for (const auto& v : response.verdicts) {
    if (v.accepted && !is_sound(v.session))
      break;
    auto* service = find(v.session.service);
    auto* session = service ? service->find(response.provider) : nullptr;
    const auto open = expected && session && session->at == phase::requested;
    const auto is_new = expected && v.session.counter > i->second.last_counter;
    if (open && v.accepted && is_new)
      accept(*service, *session, v, now);
    else if (open && v.accepted)
      refuse(*service, response.provider, "its counter did not rise", {}, now);
    else if (open)
      refuse(*service, response.provider, v.why, v.instead, now);
    else if (v.accepted && !find(v.session)) // not just a duplicate
      send_end({v.session, messages::end_reason::no_data,
                messages::side::requester});
  }
  if (expected)
    refuse_requested(response.provider, "not answered", now);
  stop_unsafe_starts(now);
  assert(is_consistent());
}

void requester::refuse_requested(provider_id provider, std::string_view why,
                                 time_point now) {
  for (auto& service : services_)
    if (const auto* session = service.find(provider);
        session && session->at == phase::requested)
      refuse(service, provider, why, std::nullopt, now);
}

void requester::accept(service_state& service, requester_session& session,
                       const messages::verdict& v, time_point now) {
  assert(session.at == phase::requested);
  assert(v.session.provider == session.provider);
  assert(v.session.is_remote());
  assert(v.accepted && !find(v.session));
  auto& newest = providers_.at(session.provider).last_counter;
  assert(v.session.counter > newest);
  newest = v.session.counter;
  session.at = phase::starting;
  session.session = v.session;
  session.accepted = session.confirmed = now;
  trace_.add(step::begun, v.session, now);
  log_verdict(service, session.provider, v.session.counter, v.why, true, now);
  port_.begin(v.session);
  wake_at(now + protocol::start_timeout, start_timeout{v.session});
  wake_at(now + protocol::confirmation_timeout,
          confirmation_check{v.session, now});
}

// @param instead  The provider that it would have asked. The vehicle decides
// about that one anew, unless another request of the service is open; the one
// that refuses is not asked again at once.
void requester::refuse(service_state& service, provider_id provider,
                       std::string_view why, std::optional<provider_id> instead,
                       time_point now) {
  assert(service.find(provider));
  assert(service.find(provider)->at == phase::requested);
  log_verdict(service, provider, 0, why, false, now);
  setup_.policy->observe(policies::refusal_outcome{
      now, service.service.name.view(), provider, why, setup_.station});
  service.drop(provider);
  assert(!service.find(provider));
  if (!instead || *instead == provider)
    return;
  const auto other = providers_.find(*instead);
  if (other == providers_.end() || service.is_moving() || service.find(*instead)
      || !service.may_ask(other->second, now))
    return;
  auto views = service.views(providers_, instead, now);
  std::erase_if(views, [&](const policies::provider_view& x) {
    return x.id != *instead && !service.find(x.id);
  });
  const auto path = setup_.path_ahead(ego_);
  for (const auto id : decide(service, views, instead, path, now))
    request(id, {service.service.name}, path, now);
}

// -- data ---------------------------------------------------------------------

void requester::on_result(const messages::service_result& result,
                          time_point now) {
  pass(now);
  const auto found = find(result.session);
  if (!found) {
    complain(result.session, now);
    return;
  }
  assert(found.session->at != phase::requested);
  assert(found.session->accepted <= now);
  found.session->confirmed = now;
  auto& service = *found.service;
  const auto provider = result.session.provider;
  if (!chain_.empty())
    learn_times(service, result, now);
  const auto latency = now - result.created;
  auto& link = service.link_of(provider);
  if (service.is_standby(provider))
    link.answered(result.created, now);
  else
    link.arrived(result.created, now);
  learn_place(service, provider, latency, false);
  setup_.policy->observe(policies::cycle_outcome{
      .at = now,
      .service = service.service.name.view(),
      .computed_at = provider,
      .latency_s = to_seconds(latency),
      .missed = !in_time(result.created, now, service.needs.max_latency),
      .energy_j = service.offloaded.energy_j,
      .station = setup_.station});
  port_.forward(result);
  look_ahead(service, now);
}

// Whether the service may come home soon, for an own function that then runs
// along.
void requester::look_ahead(service_state& service, time_point now) {
  if (service.service.options.warm_standby == duration{0}
      || !service.is_remote())
    return;
  const auto path = setup_.path_ahead(ego_);
  const auto known = service.views(providers_, std::nullopt, now);
  const auto ahead = forecasts(service, known, path);
  assert(ahead.empty() || ahead.size() == known.size());
  auto context = context_of(service, known, {}, path, now);
  context.forecasts = ahead;
  if (setup_.policy->foresees_home(context))
    port_.foresee_home(service.service.name);
}

void requester::on_digest(const messages::session_digest& digest, peer_id from,
                          time_point now) {
  pass(now);
  const auto i = providers_.find(digest.provider);
  if (digest.station != setup_.station || i == providers_.end()
      || i->second.peer != from)
    return;
  assert(i->second.offered_at <= now);
  trace_.add(step::digest_got, digest, now);
  end_unconfirmed(digest, now);
  // What answers an open request may not have come yet.
  if (!i->second.open_request)
    end_unknown(digest, i->second.last_correction, now);
  assert(is_consistent());
}

// Ends once more, at the provider, what runs there for nothing.
void requester::end_unknown(const messages::session_digest& digest,
                            std::optional<time_point>& last, time_point now) {
  assert(digest.station == setup_.station);
  assert(!providers_.at(digest.provider).open_request);
  assert(!last || *last <= now);
  if (last && now - *last < protocol::unknown_result_period)
    return;
  for (const auto& service : services_) {
    const auto running =
        std::ranges::find_if(digest.running, [&](const auto& x) {
          return x.provider == digest.provider && x.station == digest.station
                 && x.is_remote() && x.service == service.service.name;
        });
    if (running == digest.running.end() || find(*running))
      continue;
    last = now;
    send_end(
        {*running, messages::end_reason::no_data, messages::side::requester});
  }
}

// Ends what the provider does not run any more: its service_end was lost. A
// first digest may have overtaken that, and a copy of it is no second one.
void requester::end_unconfirmed(const messages::session_digest& digest,
                                time_point now) {
  assert(digest.station == setup_.station);
  assert(providers_.contains(digest.provider));
  for (auto& service : services_) {
    auto* session = service.find(digest.provider);
    if (!session || session->at == phase::requested
        || session->session.counter > digest.last_counter)
      continue;
    const auto is_named =
        std::ranges::count(digest.running, session->session) > 0;
    auto& since = session->unnamed_since;
    assert(!since || *since <= now);
    assert(session->accepted <= now);
    if (is_named) {
      session->confirmed = now;
      since.reset();
    } else if (!since) {
      since = now;
    } else if (now - *since >= protocol::digest_period / 2) {
      end(service, digest.provider,
          {messages::end_reason::no_data, "its provider runs it no longer"},
          false, now);
    }
  }
}

// A provider that sends results of no session has missed a service_end.
void requester::complain(const messages::session_id& session, time_point now) {
  const auto i = providers_.find(session.provider);
  if (i == providers_.end())
    return;
  assert(!find(session));
  trace_.add(step::result_refused, session, now);
  auto& last = i->second.last_complaint;
  if (last && now - *last < protocol::unknown_result_period)
    return;
  last = now;
  log(messages::event_type::result_refused, session, "session_over", now);
  send_end({session, messages::end_reason::no_data, messages::side::requester});
}

void requester::on_first_data(const messages::session_id& session,
                              time_point now) {
  pass(now);
  assert(session.is_remote());
  const auto found = find(session);
  if (!found || found.session->at != phase::starting)
    return;
  trace_.add(step::first_data, session, now);
  auto& service = *found.service;
  auto& started = *found.session;
  assert(started.accepted <= now);
  if (!service.is_remote())
    service.since = now;
  started.joined =
      std::ranges::any_of(service.sessions, [&](const requester_session& x) {
        return x.at == phase::remote && service.wants(x.provider);
      });
  started.at = phase::remote;
  started.first_data = now;
  announce_placement();
  if (started.joined)
    log(messages::event_type::joined, session, {}, now);
  else
    log_switch(session, true, now);
  leave_unwanted(service, now);
  predict_response(now);
  assert(is_consistent());
}

// -- the end of a session -----------------------------------------------------

void requester::on_violation(const messages::qos_violation& violation,
                             time_point now) {
  pass(now);
  const auto& session = violation.session;
  assert(session.is_remote());
  const auto reason = reason_of(violation.breach);
  if (violation.breach == messages::qos_breach::implausible) {
    // Also if the session has ended in the same instant.
    port_.record(
        messages::event_record{.at = now,
                               .what = messages::event_type::implausible,
                               .station = setup_.station,
                               .provider = session.provider,
                               .service = session.service,
                               .counter = session.counter,
                               .detail = violation.why,
                               .check = violation.check});
    distrust_peer_of(session.provider, now);
  }
  const auto found = find(session);
  if (!found)
    return;
  const auto is_fault = violation.breach != messages::qos_breach::scene;
  if (is_fault)
    trace_.add(step::violation, session, now, violation.why);
  if (is_fault && violation.breach != messages::qos_breach::implausible)
    log(messages::event_type::violation, session, violation.why, now);
  auto& service = *found.service;
  if (violation.breach == messages::qos_breach::gap
      || violation.breach == messages::qos_breach::input_age)
    learn_missed(service, session.provider);
  if (is_fault && violation.breach != messages::qos_breach::latency)
    observe_missed(service, session.provider, now);
  if (!violation.others_hold && found.session->at == phase::remote)
    leave_beside(service, session.provider, violation.why, now);
  assert(service.find(session.provider));
  end(service, session.provider, {reason, violation.why}, true, now);
  assert(!service.find(session.provider));
  assert(is_consistent());
}

void requester::on_end(const messages::service_end& e, time_point now) {
  pass(now);
  if (const auto found = find(e.session);
      found && e.from == messages::side::provider) {
    trace_.add(step::end_got, e, now);
    end(*found.service, e.session.provider,
        {e.reason, std::string{messages::told_by_provider}}, false, now);
  }
  assert(e.from != messages::side::provider || !find(e.session));
  assert(is_consistent());
}

void requester::shut_down(time_point now) {
  pass(now);
  trace_.add(step::shut_down, 0, setup_.station, now);
  for (auto& service : services_) {
    const auto all = service.sessions;
    for (const auto& session : all)
      if (session.at != phase::requested)
        end(service, session.provider, messages::end_reason::shutdown, true,
            now);
    assert(!service.is_remote());
  }
}

// Ends a service at those of the providers that run it of which that is true.
// @returns at which.
std::vector<provider_id>
requester::leave(service_state& service, const ending& why, time_point now,
                 const std::function<bool(provider_id)>& is_meant) {
  assert(is_meant);
  std::vector<provider_id> left;
  const auto is_left = [&](const requester_session& x) {
    return x.at == phase::remote && is_meant(x.provider);
  };
  for (const auto& session : service.sessions)
    if (is_left(session))
      left.push_back(session.provider);
  for (const auto id : left)
    end(service, id, why, true, now);
  assert(std::ranges::none_of(service.sessions, is_left));
  return left;
}

void requester::leave_unwanted(service_state& service, time_point now) {
  const auto left =
      leave(service,
            {messages::end_reason::handed_over,
             service.wanted.empty()
                 ? std::string{}
                 : fmt::format("to provider_id {}", service.wanted.front())},
            now, [&](provider_id id) { return !service.wants(id); });
  if (!left.empty())
    service.since = now;
}

// Nothing usable has come from the others either; but it is one violation.
void requester::leave_beside(service_state& service, provider_id violator,
                             std::string_view why, time_point now) {
  assert(service.find(violator));
  const auto left =
      leave(service,
            {messages::end_reason::released,
             fmt::format("beside provider_id {}: {}", violator, why)},
            now, [&](provider_id id) { return id != violator; });
  for (const auto id : left)
    service.cool_until[id] = now + protocol::cool_down;
}

// Closes a session, once. The selector goes on with the vehicle's own function,
// unless another provider runs the service too.
void requester::end(service_state& service, provider_id provider,
                    const ending& why, bool tell, time_point now) {
  assert(service.find(provider));
  const auto reason = why.reason;
  const auto ended = *service.find(provider);
  assert(ended.at != phase::requested);
  assert(ended.session.provider == provider);
  assert(ended.at == phase::remote || ended.first_data == time_point{});
  service.drop(provider);
  assert(!find(ended.session));
  messages::service_end e{ended.session, reason, messages::side::requester};
  trace_.add(step::closed, e, now);
  port_.end(e);
  if (tell) {
    e.what = service.service.own->termination_message(e, now, ego_.own);
    send_end(e);
  }
  log_end(service, ended, why, now);
  learn_from(service, ended, reason, now);
  std::erase_if(service.cool_until,
                [now](const auto& other) { return other.second <= now; });
  if (!messages::is_planned(reason))
    service.cool_until[provider] = now + protocol::cool_down;
  if (ended.at == phase::remote)
    announce_placement();
}

void requester::log_end(service_state& service, const requester_session& ended,
                        const ending& why, time_point now) {
  assert(ended.accepted <= now);
  assert(!service.find(ended.provider));
  const auto was_remote = ended.at == phase::remote;
  const auto comes_home = was_remote && !service.is_remote();
  port_.record(messages::episode_record{
      .session = ended.session,
      .of = messages::side::requester,
      .accepted = ended.accepted,
      .first_data = was_remote ? ended.first_data : ended.accepted,
      .got_data = was_remote,
      .ended = now,
      .reason = why.reason,
      .fallback = !messages::is_planned(why.reason) && comes_home,
      .because = why.because});
  if (comes_home) {
    service.since = now;
    log_switch(ended.session, false, now);
    predict_response(now);
  } else if (was_remote) {
    log(messages::event_type::left, ended.session,
        messages::name_of(why.reason), now);
    auto& other = *service.find(service.current().value());
    if (!ended.joined && std::exchange(other.joined, false))
      log_switch(other.session, true, now);
  }
}

// The policy learns of a cycle of which no result came in time.
void requester::observe_missed(const service_state& service,
                               provider_id provider, time_point now) {
  setup_.policy->observe(policies::cycle_outcome{
      .at = now,
      .service = service.service.name.view(),
      .computed_at = provider,
      .latency_s = std::numeric_limits<double>::infinity(),
      .missed = true,
      .energy_j = service.offloaded.energy_j,
      .station = setup_.station});
}

void requester::learn_from(const service_state& service,
                           const requester_session& ended,
                           messages::end_reason reason, time_point now) {
  if (ended.at != phase::remote)
    return;
  assert(ended.first_data <= now);
  assert(!service.find(ended.provider));
  setup_.policy->observe(
      policies::episode_outcome{service.service.name.view(), ended.provider,
                                to_seconds(now - ended.first_data),
                                messages::name_of(reason), setup_.station});
}

void requester::send_end(const messages::service_end& e) {
  const auto i = providers_.find(e.session.provider);
  if (i == providers_.end())
    return;
  trace_.add(step::end_sent, e, now_);
  port_.send(i->second.peer, e);
}

} // namespace sofof::offloading
