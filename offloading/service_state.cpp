// What follows from where a service runs and what is known of providers.
#include "offloading/service_state.hpp"

#include "base/protocol.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::offloading {

namespace {

policies::time_law run_time_law(const world::cycle_options& x) {
  return policies::time_law::normal(x.run_time_mean, x.run_time_sd,
                                    x.run_time_max);
}

} // namespace

bool known_provider::offers(const messages::service_name& service) const {
  return std::ranges::find(offer.services, service) != offer.services.end();
}

point known_provider::position(time_point now) const {
  assert(offered_at <= now);
  if (!offer.moves)
    return offer.position;
  const auto since = now - offer.created.value_or(offered_at);
  const auto passed =
      std::clamp(since, duration{0}, duration{protocol::offer_validity});
  assert(passed >= duration{0});
  return offer.position + to_seconds(passed) * offer.moves->velocity_mps;
}

service_state::service_state(onboard_service what,
                             const world::computer_options& computer,
                             time_point now)
    : service{std::move(what)}, needs{service.options.period,
                                      service.options.limits.max_latency,
                                      service.options.limits.max_interarrival,
                                      worst_response(offloading::on(
                                          computer, service.options))},
      own_response{
          offloading::own_response(offloading::on(computer, service.options))},
      on_board{world::on_board_cost(computer, service.options.compute)},
      offloaded{offloaded_cost(computer, service.options)}, since{now},
      times{service.options.per_input ? duration{0} : service.options.period,
            service.options.input_period,
            run_time_law(offloading::on(computer, service.options).compute),
            {}} {
  assert(service.own);
  assert(needs.period > duration{0});
  assert(needs.max_latency > duration{0}
         && needs.max_interarrival > duration{0});
}

requester_session* service_state::find(provider_id provider) {
  const auto i =
      std::ranges::find(sessions, provider, &requester_session::provider);
  return i == sessions.end() ? nullptr : &*i;
}

const requester_session* service_state::find(provider_id provider) const {
  const auto i =
      std::ranges::find(sessions, provider, &requester_session::provider);
  return i == sessions.end() ? nullptr : &*i;
}

void service_state::drop(provider_id provider) {
  std::erase_if(sessions, [provider](const requester_session& x) {
    return x.provider == provider;
  });
  assert(!find(provider));
}

bool service_state::wants(provider_id provider) const {
  return std::ranges::find(wanted, provider) != wanted.end();
}

bool service_state::is_standby(provider_id provider) const {
  const auto is_another = [provider](const requester_session& x) {
    return x.at == phase::remote && x.provider != provider;
  };
  return stands_by(standing_by, provider,
                   std::ranges::any_of(sessions, is_another));
}

bool service_state::is_moving() const {
  return std::ranges::any_of(sessions, [](const requester_session& x) {
    return x.at != phase::remote;
  });
}

bool service_state::is_remote() const {
  return std::ranges::find(sessions, phase::remote, &requester_session::at)
         != sessions.end();
}

bool service_state::is_consistent() const {
  const auto is_sound = [this](const requester_session& x) {
    const auto runs = x.session.provider == x.provider
                      && x.session.service == service.name
                      && x.session.is_remote();
    return (x.at == phase::requested || runs) && find(x.provider) == &x
           && (x.at != phase::remote || x.accepted <= x.first_data)
           && (x.at == phase::remote || !x.joined);
  };
  return std::ranges::all_of(sessions, is_sound)
         && is_remote() == current().has_value()
         && (!standing_by || wants(standing_by->provider));
}

std::optional<provider_id> service_state::current() const {
  const auto i =
      std::ranges::find_if(sessions, [this](const requester_session& x) {
        return x.at == phase::remote && !is_standby(x.provider);
      });
  if (i == sessions.end())
    return std::nullopt;
  return i->provider;
}

std::optional<duration> service_state::safe_response(time_point now) const {
  if (!scene)
    return std::nullopt;
  assert(scene->at <= now);
  const auto& options = service.options;
  if (service.follows.view().empty()) // what it detects has to be there
    return now - scene->at > 2 * options.input_period ? duration{0}
                                                      : scene->safe_response;
  // What was told counts until its silence is the watchdog's.
  const auto is_new = now - scene->at <= std::max(
                          2 * options.period, options.limits.max_interarrival);
  return is_new ? std::optional{scene->safe_response} : std::nullopt;
}

duration service_state::computing(const messages::service_offer& offer) const {
  return from_seconds(to_seconds(offer.computing)
                      * world::demand_of(service.options.compute));
}

policies::link_estimator& service_state::link_of(provider_id provider) {
  return links
      .try_emplace(provider,
                   policies::link_estimator_options{.period = needs.period})
      .first->second;
}

bool service_state::may_ask(const known_provider& provider,
                            time_point now) const {
  assert(provider.offered_at <= now);
  const auto cool = cool_until.find(provider.offer.provider);
  const auto cools = cool != cool_until.end() && now < cool->second;
  const auto is_old = now - provider.offered_at > protocol::offer_validity;
  return provider.offers(service.name) && !is_old && !cools
         && !provider.open_request && !provider.doubted.holds(now);
}

policies::provider_view service_state::view_of(const known_provider& provider,
                                               time_point now) {
  const auto& offer = provider.offer;
  assert(needs.max_latency > duration{0}
         && needs.max_interarrival > duration{0});
  assert(provider.offered_at <= now);
  const auto& link = link_of(offer.provider);
  // A provider that stands by is silent for no fault.
  const auto as_of =
      is_standby(offer.provider) ? link.last().value_or(now) : now;
  return {.id = offer.provider,
          .at = provider.position(now),
          .utilisation = std::max(0.0, offer.utilisation),
          .workers = offer.workers,
          .computing_s = to_seconds(computing(offer)),
          .link = {link.late_probability(needs.max_latency, as_of),
                   link.gap_probability(needs.max_interarrival, as_of),
                   link.latency_quantile(0.5), link.latency_quantile(0.99)},
          .cost = offloaded,
          .velocity_mps = offer.moves ? offer.moves->velocity_mps : point{},
          .reach_m =
              offer.moves ? std::optional{offer.moves->reach_m} : std::nullopt};
}

std::vector<policies::provider_view>
service_state::views(const known_providers& providers,
                     std::optional<provider_id> offering, time_point now) {
  assert(is_consistent());
  std::vector<policies::provider_view> all;
  for (const auto& session : sessions)
    if (const auto i = providers.find(session.provider); i != providers.end())
      all.push_back(view_of(i->second, now));
  const auto add = [&](const auto& known) {
    if (!find(known.first) && may_ask(known.second, now))
      all.push_back(view_of(known.second, now));
  };
  if (offering)
    if (const auto i = providers.find(*offering); i != providers.end())
      add(*i);
  for (const auto& known : providers)
    if (known.first != offering)
      add(known);
  assert(all.size() <= providers.size()); // none of them twice
  assert(std::ranges::all_of(all, [&](const policies::provider_view& view) {
    return find(view.id) || may_ask(providers.at(view.id), now);
  }));
  return all;
}

std::vector<candidate>
service_state::candidates(std::vector<policies::provider_view> all,
                          point from) const {
  if (all.size() > protocol::most_candidates) {
    std::ranges::stable_sort(all, {}, [&](const policies::provider_view& view) {
      return distance_m(view.at, from);
    });
    all.resize(protocol::most_candidates);
    std::ranges::sort(all, {}, &policies::provider_view::id);
  }
  assert(all.size() <= protocol::most_candidates);
  assert(std::ranges::none_of(all, [this](const policies::provider_view& view) {
    return find(view.id);
  }));
  assert(std::ranges::is_sorted(all, {}, &policies::provider_view::id));
  std::vector<candidate> told;
  for (const auto& view : all)
    told.push_back(
        {view.id, policies::gain(view, on_board, needs), view.utilisation});
  return told;
}

} // namespace sofof::offloading
