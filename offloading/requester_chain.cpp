// What a requester knows of services that form a chain, and how late the
// vehicle will respond to what it sees when they run elsewhere.
#include "base/reason.hpp"
#include "offloading/qos_monitor.hpp"
#include "offloading/requester.hpp"
#include "offloading/service_chain.hpp"

#include <cassert>
#include <utility>
#include <vector>

namespace sofof::offloading {

namespace {

/// Fewer results of a service do not tell what others will take.
constexpr double least_results = 20;

} // namespace

// Only the first result of each input counts: a later one of the same input has
// waited for a further cycle.
void requester::learn_times(service_state& service,
                            const messages::service_result& result,
                            time_point now) {
  assert(result.session.is_remote());
  const auto& [input_at, up, queue, computing, down] = result.timing;
  if (input_at <= service.answered_input || input_at > now)
    return;
  service.answered_input = input_at;
  assert(service.answered_input <= now);
  auto& there = service.times.at[result.session.provider];
  there.up.add(up.wait + up.travel);
  there.computing.add(queue + computing);
  there.down.add(down.wait + down.travel);
  if (there.down.count() == least_results)
    predict_response(now);
}

// Where few results came, the way is that of offers, and the computing as these
// say.
policies::service_times
requester::times_of(const service_state& service) const {
  auto times = service.times;
  for (const auto& [id, provider] : providers_) {
    auto& there = times.at[id];
    if (there.down.count() >= least_results)
      continue;
    there.up = there.down = provider.way;
    there.computing =
        policies::time_law::exactly(service.computing(provider.offer));
  }
  assert(times.at.size() >= service.times.at.size());
  return times;
}

std::vector<policies::chain_link> requester::chain_view(time_point now) {
  std::vector<policies::chain_link> chain;
  for (const auto& name : chain_) {
    auto* service = find(name);
    assert(service);
    const auto moves = service->is_moving();
    chain.push_back({.service = service->service.name.view(),
                     .place = moves && !service->wanted.empty()
                                  ? service_place{service->wanted.front()}
                                  : service->current(),
                     .moves = moves,
                     .providers = service->views(providers_, std::nullopt, now),
                     .needs = service->needs,
                     .on_board = service->on_board,
                     .resting_j = setup_.computer.resting_share
                                  * service->on_board.energy_j,
                     .times = times_of(*service)});
  }
  assert(chain.size() == chain_.size());
  return chain;
}

void requester::predict_response(time_point now) {
  if (chain_.empty())
    return;
  messages::prediction_record found{
      .at = now, .station = setup_.station, .split = {}};
  std::vector<policies::service_times> times;
  for (const auto& name : chain_) {
    const auto* service = find(name);
    assert(service);
    found.split.push_back(service->current());
    times.push_back(times_of(*service));
    const auto& place = found.split.back();
    if (place && times.back().at[*place].down.count() < least_results)
      return; // too few results, or offers, for a 99 %
  }
  assert(times.size() == chain_.size());
  const auto law = policies::predicted_response(times, found.split);
  if (!law.is_known())
    return;
  found.p50 = *law.quantile(0.5);
  found.p99 = *law.quantile(0.99);
  assert(found.p50 <= found.p99);
  port_.record(std::move(found));
}

// No policy is asked while a source starts, and meanwhile the scene may become
// unsafe under the time of the split that this would make.
void requester::stop_unsafe_starts(time_point now) {
  if (!setup_.policy->needs_scene())
    return;
  for (auto& service : services_) {
    if (!service.is_moving())
      continue;
    const auto all = chain_of(services_, service);
    const auto safe = safe_response_of(all, now);
    const auto worst = worst_response_of(all, service);
    if (!safe || worst <= *safe)
      continue;
    std::vector<provider_id> starting;
    for (const auto& x : service.sessions)
      if (x.at == phase::starting)
        starting.push_back(x.provider);
    for (const auto id : starting)
      end(service, id,
          {messages::end_reason::released,
           in_words("safe_response", *safe, worst)},
          true, now);
    assert(starting.empty() || !service.find(starting.front()));
  }
  assert(is_consistent());
}

} // namespace sofof::offloading
