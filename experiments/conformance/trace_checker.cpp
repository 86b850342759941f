// Each step goes to the rules of its part, and to those between parts.
#include "experiments/conformance/trace_checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::experiments::conformance {

trace_checker::trace_checker(duration slack, services_before chain)
    : slack_{slack}, messages_{sink()}, vehicles_{slack, sink()},
      chains_{slack, std::move(chain), sink()} {
  assert(slack >= duration{0});
}

breach_sink trace_checker::sink() {
  return [this](breach&& x) { breaches_.push_back(std::move(x)); };
}

bool trace_checker::is_well_formed(const messages::trace_record& x) {
  using enum messages::trace_step;
  switch (x.what) {
    case offer_sent:
    case offer_got:
    case request_sent:
    case request_got:
    case response_sent:
    case response_got:
    case digest_sent:
    case digest_got:
      return x.by != messages::trace_part::selector;
    case request_over:
    case heard:
    case met:
    case forgotten:
    case peer_lost:
    case shut_down:
      return x.by != messages::trace_part::selector && x.services.empty();
    default:
      return x.services.size() == 1;
  }
}

template <class Rules>
void trace_checker::follow(parts<Rules>& all, const part_key& who,
                           const messages::trace_record& x, trace_place at) {
  auto i = all.find(who);
  if (i == all.end() || x.step == 1)
    i = all.insert_or_assign(who, followed<Rules>{{slack_, sink()}, 0}).first;
  auto& [rules, last] = i->second;
  if (x.step != last + 1)
    sink()({rule_of("M2"),
            fmt::format("{} after {} of a {}", x.step, last,
                        messages::name_of(x.by)),
            at});
  last = x.step;
  rules.add(x, at);
}

void trace_checker::add(const messages::trace_record& x, trace_place at) {
  assert(is_well_formed(x));
  ++steps_;
  messages_.add(x, at);
  vehicles_.add(x, at);
  chains_.add(x, at);
  switch (x.by) {
    case messages::trace_part::requester:
      return follow(requesters_, {at.trace, x.by, 0, x.station, {}}, x, at);
    case messages::trace_part::provider:
      return follow(providers_, {at.trace, x.by, x.provider, 0, {}}, x, at);
    case messages::trace_part::selector:
      return follow(selectors_,
                    {at.trace, x.by, 0, x.station, x.services.front().name}, x,
                    at);
  }
}

const std::vector<breach>& trace_checker::finish() {
  for (auto& [who, x] : requesters_)
    x.rules.finish();
  for (auto& [who, x] : providers_)
    x.rules.finish();
  messages_.finish();
  vehicles_.finish();
  chains_.finish();
  std::ranges::stable_sort(breaches_, {}, &breach::at);
  return breaches_;
}

} // namespace sofof::experiments::conformance
