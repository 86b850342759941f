// Timers, providers, decisions and requests; the rest is in
// requester_sessions.cpp.
#include "offloading/requester.hpp"

#include "base/protocol.hpp"
#include "base/text/words.hpp"
#include "offloading/qos_monitor.hpp"
#include "offloading/service_chain.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::offloading {

requester::requester(requester_setup setup, requester_port& port,
                     time_point now)
    : setup_{std::move(setup)}, port_{port},
      trace_{messages::trace_part::requester, sink_of(setup_.trace, port)},
      now_{now} {
  assert(setup_.policy && setup_.path_ahead);
  for (auto& service : setup_.services) {
    assert(!find(service.name));
    services_.emplace_back(std::move(service), setup_.computer, now);
  }
  for (const auto& service : services_)
    if (const auto all = chain_of(services_, service); all.size() > 1) {
      for (const auto* x : all)
        chain_.push_back(x->service.name);
      break;
    }
  announce_placement();
  epoch_ = from_seconds(setup_.policy->epoch_s());
  if (epoch_ > duration{0})
    wake_at(now + epoch_, epoch_end{});
}

void requester::pass(time_point now) {
  assert(now >= now_);
  now_ = now;
}

// Only providers that are known run or are asked for anything; what a provider
// is asked for waits for the answer to an open request, and what it runs has a
// counter that it has used.
bool requester::is_consistent() const {
  const auto is_known = [this](const requester_session& x) {
    const auto provider = providers_.find(x.provider);
    if (provider == providers_.end())
      return false;
    if (x.at == phase::requested)
      return provider->second.open_request.has_value();
    return x.session.counter <= provider->second.last_counter
           && x.accepted <= x.confirmed && x.confirmed <= now_
           && x.unnamed_since.value_or(now_) <= now_;
  };
  return std::ranges::all_of(services_, [&](const service_state& service) {
    return service.is_consistent()
           && std::ranges::all_of(service.sessions, is_known);
  });
}

service_state* requester::find(const messages::service_name& service) {
  const auto i = std::ranges::find(
      services_, service,
      [](const service_state& x) -> const messages::service_name& {
        return x.service.name;
      });
  return i == services_.end() ? nullptr : &*i;
}

requester::found_session requester::find(const messages::session_id& session) {
  auto* service = find(session.service);
  auto* found = service ? service->find(session.provider) : nullptr;
  if (!found || found->at == phase::requested || found->session != session)
    return {};
  return {service, found};
}

void requester::announce_placement() {
  port_.on_placement(std::ranges::any_of(services_, &service_state::is_remote));
}

// -- timers -------------------------------------------------------------------

void requester::wake_at(time_point t, timer what) {
  port_.wake_at(t, timers_.add(what));
}

void requester::on_timer(std::uint64_t number, time_point now) {
  pass(now);
  if (const auto due = timers_.claim(number))
    std::visit([&](const auto& x) { expire(x, now); }, *due);
}

void requester::expire(const request_timeout& x, time_point now) {
  const auto i = providers_.find(x.provider);
  if (i == providers_.end() || i->second.open_request != x.number)
    return;
  i->second.open_request.reset();
  trace_.add(step::request_over, x.provider, setup_.station, now, {}, x.number);
  refuse_requested(x.provider, "no answer", now);
  assert(is_consistent());
}

void requester::expire(const start_timeout& x, time_point now) {
  const auto found = find(x.session);
  if (found && found.session->at == phase::starting) {
    learn_missed(*found.service, x.session.provider);
    observe_missed(*found.service, x.session.provider, now);
    end(*found.service, x.session.provider,
        {messages::end_reason::no_data,
         in_words("no_data", now - found.session->accepted,
                  protocol::start_timeout)},
        true, now);
  }
  assert(is_consistent());
}

// One timer for each session is under way; it moves on with what comes.
void requester::expire(const confirmation_check& x, time_point now) {
  const auto found = find(x.session);
  if (!found || found.session->accepted != x.accepted)
    return;
  const auto confirmed = found.session->confirmed;
  assert(confirmed <= now);
  if (now >= confirmed + protocol::confirmation_timeout)
    end(*found.service, x.session.provider,
        {messages::end_reason::no_data,
         in_words("unconfirmed", now - confirmed,
                  protocol::confirmation_timeout)},
        true, now);
  else
    wake_at(confirmed + protocol::confirmation_timeout, x);
  assert(is_consistent());
}

// The policy learns of cycles on board once an epoch.
void requester::expire(const epoch_end&, time_point now) {
  assert(epoch_ > duration{0});
  wake_at(now + epoch_, epoch_end{});
  for (const auto& x : services_) {
    assert(x.needs.period > duration{0});
    if (!x.is_remote())
      setup_.policy->observe(policies::cycle_outcome{
          .at = now,
          .service = x.service.name.view(),
          .latency_s = x.on_board.time_s,
          .energy_j = x.on_board.energy_j,
          .cycles = to_seconds(epoch_) / to_seconds(x.needs.period),
          .station = setup_.station});
  }
  weigh([](const service_state&) { return true; }, std::nullopt, now);
}

// -- providers ----------------------------------------------------------------

void requester::on_safe_response(const messages::service_name& service,
                                 duration longest, time_point now) {
  pass(now);
  assert(longest >= duration{0});
  if (auto* known = find(service)) {
    known->scene = {now, longest};
    stop_unsafe_starts(now);
  }
}

// A list of bounded length, whatever an offer says.
std::string
requester::own_services_of(const messages::service_offer& offer) const {
  std::string all;
  for (const auto& x : services_)
    if (std::ranges::count(offer.services, x.service.name))
      add_word(all, x.service.name.view());
  return all;
}

void requester::on_offer(const messages::service_offer& offer, peer_id from,
                         time_point now) {
  pass(now);
  if (offer.provider == 0) // no provider has this number
    return;
  log(messages::event_type::offer, {offer.provider, setup_.station, {}, 0},
      own_services_of(offer), now);
  auto& provider = meet(offer.provider, from);
  assert(provider.offered_at <= now);
  if (provider.peer != from)
    return;
  trace_.add(step::offer_got, offer, setup_.station, now);
  provider.offer = offer;
  provider.offered_at = now;
  if (!chain_.empty() && offer.created && *offer.created <= now)
    provider.way.add(now - *offer.created);
  learn(offer, now);
  if (provider.open_request)
    return;
  weigh([&](const service_state& x) { return provider.offers(x.service.name); },
        offer.provider, now);
  assert(is_consistent());
}

known_provider& requester::meet(provider_id id, peer_id peer) {
  if (const auto i = providers_.find(id); i != providers_.end())
    return i->second;
  assert(!is_in_use(id));
  trace_.add(step::met, id, setup_.station, now_, {},
             static_cast<std::uint64_t>(peer));
  // A peer speaks for one provider, which has started again since.
  const auto is_same = [peer](const auto& known) {
    return known.second.peer == peer;
  };
  const auto before = std::ranges::find_if(providers_, is_same);
  // A provider that is doubted stays so when it has started again.
  const auto doubted =
      before != providers_.end() ? before->second.doubted : distrust{};
  std::erase_if(providers_, [&](const auto& known) {
    const auto is_over = is_same(known) && !is_in_use(known.first);
    if (is_over)
      trace_.add(step::forgotten, known.first, setup_.station, now_, {},
                 static_cast<std::uint64_t>(known.second.peer));
    return is_over;
  });
  for (auto& service : services_)
    std::erase_if(service.links, [&](const auto& link) {
      return !providers_.contains(link.first);
    });
  return providers_
      .emplace(id, known_provider{.peer = peer, .doubted = doubted})
      .first->second;
}

bool requester::is_peer_of(provider_id provider, peer_id peer) const {
  const auto known = providers_.find(provider);
  return known != providers_.end() && known->second.peer == peer;
}

bool requester::is_in_use(provider_id id) const {
  return std::ranges::any_of(services_, [id](const service_state& service) {
    return service.find(id) != nullptr;
  });
}

// Offers show how good the link is, also while nothing runs there.
void requester::learn(const messages::service_offer& offer, time_point now) {
  if (!offer.created || *offer.created > now)
    return;
  for (auto& service : services_)
    if (!service.find(offer.provider) || service.is_standby(offer.provider)) {
      const auto created = *offer.created - service.computing(offer);
      service.link_of(offer.provider).answered(created, now);
      learn_place(service, offer.provider, now - created, true);
    }
}

// For all services: they come from one computer, under one key.
void requester::distrust_peer_of(provider_id provider, time_point now) {
  const auto doubted = providers_.find(provider);
  if (doubted == providers_.end())
    return;
  for (auto& [id, known] : providers_)
    if (known.peer == doubted->second.peer)
      known.doubted.add(now);
}

void requester::on_lost(peer_id peer, time_point now) {
  pass(now);
  for (auto i = providers_.begin(); i != providers_.end();) {
    if (i->second.peer != peer) {
      ++i;
      continue;
    }
    const auto id = i->first;
    i = providers_.erase(i);
    trace_.add(step::peer_lost, id, setup_.station, now);
    log(messages::event_type::peer_lost, {id, setup_.station, {}, 0}, {}, now);
    for (auto& service : services_) {
      const auto* session = service.find(id);
      if (session && session->at == phase::requested)
        refuse(service, id, "peer lost", std::nullopt, now);
      else if (session)
        end(service, id, messages::end_reason::peer_lost, false, now);
      service.links.erase(id);
    }
    assert(!is_in_use(id));
  }
  assert(std::ranges::none_of(providers_, [peer](const auto& known) {
    return known.second.peer == peer;
  }));
  assert(is_consistent());
}

// -- decision and request -----------------------------------------------------

// Decides about the services for which `is_due`.
template <class Predicate>
void requester::weigh(Predicate is_due, std::optional<provider_id> offering,
                      time_point now) {
  assert(!offering || !providers_.at(*offering).open_request);
  std::map<provider_id, std::vector<messages::service_name>> wanted;
  const auto path = setup_.path_ahead(ego_);
  for (auto& service : services_)
    if (!service.is_moving() && is_due(service))
      for (const auto id :
           decide(service, service.views(providers_, offering, now), offering,
                  path, now)) {
        wanted[id].push_back(service.service.name);
        service.is_leaving = true;
      }
  for (auto& service : services_)
    service.is_leaving = false;
  for (auto& [id, names] : wanted)
    request(id, std::move(names), path, now);
}

// @param providers  That come into question.
// @returns which shall be asked for the service.
std::vector<provider_id>
requester::decide(service_state& service,
                  std::span<const policies::provider_view> providers,
                  std::optional<provider_id> offering,
                  std::span<const point> path, time_point now) {
  assert(service.is_consistent());
  assert(!offering || providers_.contains(*offering));
  const auto knows = [&](provider_id id) {
    return std::ranges::find(providers, id, &policies::provider_view::id)
           != providers.end();
  };
  if (providers.empty() || (offering && !knows(*offering)))
    return {};
  ++decisions_;
  const auto chain = setup_.policy->needs_chain()
                         ? chain_view(now)
                         : std::vector<policies::chain_link>{};
  const auto ahead = forecasts(service, providers, path);
  auto context = context_of(service, providers, chain, path, now);
  context.forecasts = ahead;
  const auto decision = setup_.policy->decide(context);
  if (std::holds_alternative<policies::come_home>(decision.what)) {
    leave(service, {messages::end_reason::released, decision.why.text()}, now,
          [](provider_id) { return true; });
    return {};
  }
  const auto second = policies::second_of(decision);
  const auto* there = std::get_if<policies::run_at>(&decision.what);
  std::vector<provider_id> wanted;
  const auto want = [&](service_place place) {
    if (place && knows(*place) && !std::ranges::count(wanted, *place))
      wanted.push_back(*place);
  };
  if (there)
    want(there->provider);
  else if (second)
    want(service.current());
  if (second)
    want(second->provider);
  if (wanted.empty()) {
    if (service.sessions.empty() && offering)
      log(messages::event_type::stay_local,
          {*offering, setup_.station, service.service.name, 0},
          decision.why.text(), now);
    return {};
  }
  assert(wanted.size() <= 2);
  service.wanted = wanted;
  set_standby(service, wanted.size() > 1 ? second->hedge_after : duration{0});
  std::erase_if(wanted, [&](provider_id id) { return service.find(id); });
  if (wanted.empty())
    leave_unwanted(service, now);
  return wanted;
}

policies::local_context
requester::context_of(const service_state& service,
                      std::span<const policies::provider_view> providers,
                      std::span<const policies::chain_link> chain,
                      std::span<const point> path, time_point now) const {
  assert(service.since <= now);
  const auto all = chain_of(services_, service);
  auto needs = service.needs;
  needs.worst_response = worst_response_of(all, service);
  return {.now = now,
          .service = service.service.name.view(),
          .providers = providers,
          .path = path,
          .speed_mps = ego_.own.speed_mps,
          .noise = setup_.noise.part("decisions"),
          .number = decisions_,
          .current = service.current(),
          .since = service.since,
          .needs = needs,
          .on_board = service.on_board,
          .safe_response = safe_response_of(all, now),
          .chain = chain,
          .future = setup_.future.get(),
          .station = setup_.station};
}

// The provider that the policy wants beside the first may only stand by.
void requester::set_standby(service_state& service, duration after) {
  std::optional<messages::standby> chosen;
  if (after > duration{0})
    chosen = {service.wanted.back(), after};
  assert(!chosen || service.wanted.size() > 1);
  if (chosen == service.standing_by)
    return;
  service.standing_by = chosen;
  trace_.add(step::standby, setup_.station, service.service.name, chosen, now_);
  port_.set_standby(service.service.name, chosen);
}

// What the vehicle tells of the providers that it could ask instead of this
// one, and of this one.
std::vector<candidate> requester::candidates(service_state& service,
                                             provider_id asked,
                                             std::span<const point> path,
                                             time_point now) {
  assert(!service.find(asked));
  const auto known = service.views(providers_, std::nullopt, now);
  const auto context = context_of(service, known, {}, path, now);
  std::vector<policies::provider_view> left;
  for (const auto& x : known)
    if (!service.find(x.id)
        && (x.id == asked || setup_.policy->objection(context, x).empty()))
      left.push_back(x);
  return service.candidates(std::move(left), ego_.own.position);
}

void requester::request(provider_id id,
                        std::vector<messages::service_name> wanted,
                        const std::vector<point>& path, time_point now) {
  assert(id != 0);
  assert(!wanted.empty());
  auto& provider = providers_.at(id);
  assert(std::ranges::all_of(wanted, [&](const messages::service_name& name) {
    return find(name)->may_ask(provider, now);
  }));
  auto told = candidates(*find(wanted.front()), id, path, now);
  const auto number = ++last_request_;
  provider.open_request = number;
  for (const auto& name : wanted) {
    std::erase(provider.offer.services, name);
    auto* service = find(name);
    assert(!service->find(id));
    service->sessions.push_back({.provider = id});
    log(messages::event_type::request, {id, setup_.station, name, 0}, {}, now);
  }
  const messages::service_request asked{
      id,   setup_.station,     number,         std::move(wanted),
      path, ego_.own.speed_mps, std::move(told)};
  trace_.add(step::request_sent, asked, now);
  port_.send(provider.peer, asked);
  wake_at(now + protocol::request_timeout, request_timeout{id, number});
}

} // namespace sofof::offloading
