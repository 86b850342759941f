// One kind of service in a vehicle: who runs it elsewhere, and who may.
#include "actors/offloading/service_state.hpp"

#include "base/protocol.hpp"

#include <algorithm>

namespace sofof {

bool known_provider::offers(std::string_view kind) const {
  return std::ranges::find(offer.kinds, kind) != offer.kinds.end();
}

requester_session* service_state::find(provider_id provider) {
  const auto i =
      std::ranges::find(elsewhere, provider, &requester_session::provider);
  return i == elsewhere.end() ? nullptr : &*i;
}

void service_state::drop(provider_id provider) {
  std::erase_if(elsewhere, [provider](const requester_session& x) {
    return x.provider == provider;
  });
}

bool service_state::wants(provider_id provider) const {
  return std::ranges::find(wanted, provider) != wanted.end();
}

bool service_state::is_standby(provider_id provider) const {
  const auto is_another = [provider](const requester_session& x) {
    return x.at == phase::remote && x.provider != provider;
  };
  return offloading::stands_by(standby, provider,
                               std::ranges::any_of(elsewhere, is_another));
}

bool service_state::is_moving() const {
  return std::ranges::any_of(elsewhere, [](const requester_session& x) {
    return x.at != phase::remote;
  });
}

bool service_state::is_remote() const {
  return std::ranges::find(elsewhere, phase::remote, &requester_session::at)
         != elsewhere.end();
}

provider_id service_state::current() const {
  const auto i =
      std::ranges::find_if(elsewhere, [this](const requester_session& x) {
        return x.at == phase::remote && !is_standby(x.provider);
      });
  return i == elsewhere.end() ? 0 : i->provider;
}

service_needs service_state::needs() const {
  const auto& common = kind->common;
  return {common.period, common.limits.max_latency,
          common.limits.max_interarrival};
}

duration service_state::computing(const service_offer& offer) const {
  return from_seconds(to_seconds(offer.computing) * kind->common.demand);
}

link_estimator& service_state::link_of(provider_id provider) {
  return links
      .try_emplace(provider,
                   link_estimator_options{.period = kind->common.period})
      .first->second;
}

bool service_state::may_ask(const known_provider& provider,
                            time_point now) const {
  const auto cool = cool_until.find(provider.offer.provider);
  const auto cools = cool != cool_until.end() && now < cool->second;
  const auto is_old = now - provider.offered_at > protocol::offer_validity;
  return provider.offers(kind->name()) && !is_old && !cools
         && !provider.open_request && !provider.doubted.holds(now);
}

provider_view service_state::view_of(const known_provider& provider,
                                     time_point now) {
  const auto& offer = provider.offer;
  const auto& limits = kind->common.limits;
  const auto& link = link_of(offer.provider);
  // Who is not called is silent for no fault.
  const auto as_of =
      is_standby(offer.provider) ? link.last().value_or(now) : now;
  return {.id = offer.provider,
          .at = offer.position,
          .utilisation = std::max(0.0, offer.utilisation),
          .workers = offer.workers,
          .computing_s = to_seconds(computing(offer)),
          .link = {link.late_probability(limits.max_latency, as_of),
                   link.gap_probability(limits.max_interarrival, as_of),
                   link.latency_quantile(0.5), link.latency_quantile(0.99)},
          .cost = offloaded};
}

std::vector<provider_view>
service_state::views(const known_providers& providers, provider_id offering,
                     time_point now) {
  std::vector<provider_view> all;
  for (const auto& at : elsewhere)
    if (const auto i = providers.find(at.provider); i != providers.end())
      all.push_back(view_of(i->second, now));
  const auto add = [&](provider_id id, const known_provider& provider) {
    if (!find(id) && may_ask(provider, now))
      all.push_back(view_of(provider, now));
  };
  if (const auto i = providers.find(offering); i != providers.end())
    add(i->first, i->second);
  for (const auto& [id, provider] : providers)
    if (id != offering)
      add(id, provider);
  return all;
}

std::vector<candidate>
service_state::candidates(const known_providers& providers, point from,
                          time_point now) {
  auto all = views(providers, 0, now);
  std::erase_if(all, [&](const provider_view& view) { return find(view.id); });
  if (all.size() > protocol::most_candidates) {
    std::ranges::stable_sort(all, {}, [&](const provider_view& view) {
      return distance_m(view.at, from);
    });
    all.resize(protocol::most_candidates);
    std::ranges::sort(all, {}, &provider_view::id);
  }
  std::vector<candidate> told;
  for (const auto& view : all)
    told.push_back({view.id, gain(view, on_board, needs()), view.utilisation});
  return told;
}

bool is_fallback(end_reason reason) {
  switch (reason) {
    case end_reason::left_area:
    case end_reason::handed_over:
    case end_reason::released:
    case end_reason::shutdown:
      return false;
    default:
      return true;
  }
}

} // namespace sofof
