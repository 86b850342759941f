// Times of a chain are sums of its services' times.
#include "offloading/service_chain.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::offloading {

namespace {

const service_state* find_by_name(std::span<const service_state> all,
                                  const messages::service_name& name) {
  const auto i = std::ranges::find_if(
      all, [&](const service_state& x) { return x.service.name == name; });
  return i == all.end() ? nullptr : &*i;
}

const service_state* next_of(std::span<const service_state> all,
                             const service_state& one) {
  const auto i = std::ranges::find_if(all, [&](const service_state& x) {
    return x.service.follows == one.service.name;
  });
  return i == all.end() ? nullptr : &*i;
}

} // namespace

std::vector<const service_state*> chain_of(std::span<const service_state> all,
                                           const service_state& one) {
  std::vector<const service_state*> chain{&one};
  while (const auto* before = find_by_name(all, chain.front()->service.follows))
    chain.insert(chain.begin(), before);
  while (const auto* next = next_of(all, *chain.back()))
    chain.push_back(next);
  assert(chain.size() <= all.size());
  return chain;
}

duration worst_response_of(std::span<const service_state* const> chain,
                           const service_state& one) {
  assert(!chain.empty());
  duration sum{0};
  for (const auto* x : chain) {
    const auto away = x == &one || x->is_leaving || !x->sessions.empty();
    const auto takes = away ? x->needs.worst_response : x->own_response;
    if (takes == duration::max())
      return takes;
    sum += takes;
    assert(sum >= duration{0});
  }
  return sum;
}

std::optional<duration>
safe_response_of(std::span<const service_state* const> chain, time_point now) {
  assert(!chain.empty());
  std::optional<duration> least;
  auto looks = false;
  for (const auto* x : chain) {
    if (const auto found = x->safe_response(now))
      least = least ? std::min(*least, *found) : found;
    looks = looks || x->service.own->looks_at_scenes();
  }
  assert(!least || *least >= duration{0});
  return least || !looks ? least : duration{0};
}

} // namespace sofof::offloading
