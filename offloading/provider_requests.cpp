// From a request to its response, and to sessions that start.
#include "base/protocol.hpp"
#include "base/random_phase.hpp"
#include "offloading/provider.hpp"

#include <algorithm>
#include <cassert>
#include <set>
#include <string>
#include <utility>

namespace sofof::offloading {

void provider::on_request(const messages::service_request& request,
                          peer_id from, time_point now) {
  pass(now);
  const auto i = stations_.find(request.station);
  if (request.provider == setup_.id)
    trace_.add(step::request_got, request, now);
  if (request.provider != setup_.id || i == stations_.end()) {
    refuse(request, from, "not heard here");
    return;
  }
  auto& station = i->second;
  assert(station.is_consistent());
  if (request.number <= station.last_request)
    return; // a duplicate, or overtaken by a newer one
  station.last_request = request.number;
  if (epoch_ == duration{0}) {
    answer({{request, from}}, now);
    assert(is_consistent());
    return;
  }
  assert(waiting_.empty() || in_epoch_);
  const auto before = drop_waiting(request.station); // it has given that up
  waiting_.push_back({request, from});
  part_from(before);
  if (!std::exchange(in_epoch_, true))
    wake_at(now + epoch_, epoch_end{});
  assert(is_consistent());
}

// @returns by whom its requests came.
std::set<peer_id> provider::drop_waiting(station_id station) {
  std::set<peer_id> dropped;
  std::erase_if(waiting_, [&](const open_request& open) {
    const auto is_meant = open.what.station == station;
    if (is_meant)
      dropped.insert(open.from);
    return is_meant;
  });
  assert(std::ranges::none_of(waiting_, [station](const open_request& open) {
    return open.what.station == station;
  }));
  return dropped;
}

void provider::part_from(const std::set<peer_id>& requesters) {
  for (const auto peer : requesters)
    if (!serves(peer))
      port_.leave(peer);
}

void provider::refuse(const messages::service_request& request, peer_id from,
                      std::string_view why) {
  // In the name that it was asked by, which it may have had before it was
  // started again.
  messages::service_response response{
      request.provider, request.station, request.number, {}};
  for (const auto& name : request.services)
    response.verdicts.push_back({{request.provider, request.station, name, 0},
                                 false,
                                 std::string{why}});
  assert(response.verdicts.size() == request.services.size());
  if (request.provider == setup_.id)
    trace_.add(step::response_sent, response, now_);
  tell(response, from);
}

void provider::tell(const messages::service_response& response, peer_id to) {
  for (const auto& v : response.verdicts) {
    assert(v.accepted == v.session.is_remote());
    port_.record(messages::verdict_record{now_, v.session, v.accepted, v.why});
  }
  port_.send(to, response);
}

// Answers requests that are decided together.
void provider::answer(std::vector<open_request> requests, time_point now) {
  assert(!requests.empty());
  assert(std::ranges::all_of(requests, [this](const open_request& open) {
    return open.what.provider == setup_.id;
  }));
  std::vector<question> questions;
  for (const auto& open : requests)
    questions.push_back(question_of(open, now));
  std::vector<policies::request_view> asked;
  for (const auto& q : questions)
    asked.insert(asked.end(), q.asked.begin(), q.asked.end());
  const auto decided = ask_policy(std::move(asked), now);
  auto next = decided.begin();
  for (auto& q : questions)
    for (const auto place : q.places)
      q.verdicts[place] =
          next == decided.end()
              ? policies::central_decision{policies::refused{}, "not decided"}
              : *next++;
  for (std::size_t k = 0; k < requests.size(); ++k)
    respond(requests[k], questions[k].verdicts, now);
  std::set<peer_id> answered;
  for (const auto& open : requests)
    answered.insert(open.from);
  part_from(answered);
}

// The policy is asked about the services that are offered, once each.
provider::question provider::question_of(const open_request& open,
                                         time_point now) {
  const auto& request = open.what;
  question all;
  for (std::size_t k = 0; k < request.services.size(); ++k) {
    const auto& name = request.services[k];
    const auto before = std::span{request.services}.first(k);
    const auto station = stations_.find(request.station);
    const auto* service = find(name);
    if (station == stations_.end()) {
      all.verdicts.push_back({policies::refused{}, "not heard here"});
    } else if (!service) {
      all.verdicts.push_back({policies::refused{}, "not offered here"});
    } else if (const auto why = service->here->objection(request.route);
               !why.empty()) {
      all.verdicts.push_back({policies::refused{}, why});
    } else if (std::ranges::find(before, name) != before.end()) {
      all.verdicts.push_back({policies::refused{}, "named twice"});
    } else {
      // A station that asks again does not run it: its service_end was lost.
      if (const auto* session = station->second.find(name))
        end(station->second, session->session,
            {messages::end_reason::no_data, "the vehicle asks again"}, true,
            now);
      all.verdicts.emplace_back();
      all.places.push_back(k);
      all.asked.push_back({.station = request.station,
                           .service = name.view(),
                           .route = request.route,
                           .speed_mps = request.speed_mps,
                           .utilisation = utilisation_by(name),
                           .task = task_of(*service),
                           .at_most = at_most(*service),
                           .candidates = request.candidates});
    }
  }
  assert(all.verdicts.size() == request.services.size());
  assert(all.asked.size() == all.places.size());
  assert(std::ranges::none_of(all.asked, [&](const policies::request_view& x) {
    return stations_.at(x.station).find(messages::service_name{x.service});
  }));
  return all;
}

// @returns one decision for each request, or fewer; sessions that the policy
// wants to be rid of are ended.
std::vector<policies::central_decision>
provider::ask_policy(std::vector<policies::request_view> asked,
                     time_point now) {
  for (auto& x : asked)
    x.links = links_of(x.station, x.service, asked);
  std::vector<policies::session_view> sessions;
  std::vector<messages::session_id> running;
  for (const auto& [id, station] : stations_)
    for (const auto& x : station.sessions) {
      sessions.push_back(
          {.station = id,
           .service = x.session.service.view(),
           .since = x.since,
           .task = x.task,
           .worker = x.worker,
           .utilisation = utilisation_by(x.session.service),
           .candidates = x.candidates,
           .at_most = at_most(*find(x.session.service)),
           .links = links_of(id, x.session.service.view(), asked)});
      running.push_back(x.session);
    }
  assert(running.size() == sessions.size());
  const auto area = area_.at(now);
  auto decided =
      setup_.policy->decide({.now = now,
                             .requests = asked,
                             .sessions = sessions,
                             .utilisation = utilisation(),
                             .workers = setup_.computer.workers,
                             .area = area,
                             .map = *setup_.map,
                             .self = setup_.id,
                             .noise = setup_.noise.part("decisions"),
                             .number = ++decisions_,
                             .area_velocity_mps = area_.velocity_mps()});
  const auto most = asked.size() + running.size();
  for (auto k = asked.size(); k < std::min(decided.size(), most); ++k)
    if (const auto& session = running[k - asked.size()];
        !policies::terms_of(decided[k]))
      end(stations_.at(session.station), session,
          {messages::end_reason::revoked, decided[k].why.text()}, true, now);
  if (decided.size() > asked.size())
    decided.resize(asked.size());
  assert(decided.size() <= asked.size());
  return decided;
}

// @param service  One that is offered here.
// @param asked    What the policy is asked about now.
policies::chain_links
provider::links_of(station_id station, std::string_view service,
                   std::span<const policies::request_view> asked) const {
  using policies::link_place;
  const auto place_of = [&](const messages::service_name& name) {
    const auto is_meant = [&](const policies::request_view& x) {
      return x.station == station && x.service == name.view();
    };
    if (std::ranges::any_of(asked, is_meant))
      return link_place::asked;
    const auto known = stations_.find(station);
    return known != stations_.end() && known->second.find(name)
               ? link_place::here
               : link_place::elsewhere;
  };
  policies::chain_links links;
  const auto* offered = find(messages::service_name{service});
  assert(offered);
  assert(offered->follows.view() != service);
  if (const auto& name = offered->follows; !name.view().empty())
    links.follows = {name.view(), place_of(name)};
  for (const auto& x : setup_.services)
    if (x.follows.view() == service)
      links.followed_by = {x.name.view(), place_of(x.name)};
  return links;
}

void provider::respond(const open_request& open,
                       const std::vector<policies::central_decision>& decisions,
                       time_point now) {
  const auto& request = open.what;
  assert(decisions.size() == request.services.size());
  messages::service_response response{
      setup_.id, request.station, request.number, {}};
  for (std::size_t k = 0; k < request.services.size(); ++k) {
    const auto& decision = decisions[k];
    messages::verdict v{
        .session = {setup_.id, request.station, request.services[k], 0},
        .why = decision.why.text()};
    if (const auto* terms = policies::terms_of(decision)) {
      v.accepted = true;
      v.session.counter = ++last_session_;
      start(stations_.at(request.station), v.session, open, *terms, now);
    } else {
      v.instead = std::get<policies::refused>(decision.what).instead;
    }
    response.verdicts.push_back(std::move(v));
  }
  assert(response.verdicts.size() == request.services.size());
  trace_.add(step::response_sent, response, now);
  tell(response, open.from);
}

void provider::start(station_record& station,
                     const messages::session_id& session,
                     const open_request& open, const policies::accepted& terms,
                     time_point now) {
  assert(session.is_remote());
  assert(!station.find(session.service));
  assert(find(session.service));
  const auto& service = *find(session.service);
  const auto drawn =
      setup_.noise.part(service.name.view()).part(session.station.value());
  auto task = task_of(service);
  task.offset = terms.offset.value_or(
      random_phase(drawn.part("remote phase"), service.options.period));
  assert(task.offset >= duration{0} && task.offset < service.options.period);
  const auto& route = open.what.route;
  const auto asked_inside =
      !route.empty() && area_.contains(route.front(), now);
  station.sessions.push_back({session, now, task, terms.worker,
                              open.what.candidates,
                              station.is_inside || asked_inside});
  trace_.add(step::begun, session, now, asked_inside ? "inside" : "outside");
  begin_digests(station, now);
  port_.start({.session = session,
               .requester = open.from,
               .phase = task.offset,
               .keeps_phase = terms.offset.has_value()});
}

} // namespace sofof::offloading
