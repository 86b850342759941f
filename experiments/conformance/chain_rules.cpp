// Inputs of a service, and the results of the one before that they are made of.
#include "experiments/conformance/chain_rules.hpp"

#include "experiments/conformance/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::experiments::conformance {

namespace {

using messages::end_reason;
using messages::trace_part;
using messages::trace_step;

/// @returns whether a session was closed by what its results were like.
bool is_violated(const messages::trace_record& x) {
  return is_for(x, end_reason::qos_latency)
         || is_for(x, end_reason::qos_input_age)
         || is_for(x, end_reason::qos_gap)
         || is_for(x, end_reason::implausible);
}

} // namespace

bool chain_rules::is_part_of_chain(const service& name) const {
  return chain_.contains(name)
         || std::ranges::any_of(
             chain_, [&](const auto& x) { return x.second == name; });
}

void chain_rules::add(const messages::trace_record& x, trace_place at) {
  if (x.services.empty() || !is_part_of_chain(x.services.front().name))
    return;
  if (x.by == trace_part::requester && x.what == trace_step::closed)
    return on_closed(x, at);
  if (x.by != trace_part::selector)
    return;
  auto& here = stages_[{{at.trace, x.station}, x.services.front().name}];
  here.last = x.at;
  if (x.what == trace_step::asked)
    here.inputs.push_back({x.at, at});
  if (x.what == trace_step::used) {
    here.results.push_back({x.at, at});
    if (here.inputs.empty() && !here.result_of_none)
      here.result_of_none = at;
  }
}

void chain_rules::on_closed(const messages::trace_record& x, trace_place at) {
  auto& ends = ends_[{at.trace, x.station}];
  if (ends.when != x.at) {
    compare(x.station, ends);
    ends = {.violated = {}, .released = {}, .when = x.at};
  }
  const closing one{x.services.front(), {x.at, at}};
  if (is_violated(x))
    ends.violated.push_back(one);
  if (is_for(x, end_reason::released))
    ends.released.push_back(one);
}

// A violation of one service and a release of another one, in either order. A
// service whose own session ends by a violation lets go of who stands by for
// it.
void chain_rules::compare(station_id station, const end_of_sessions& ends) {
  const auto is_of = [](const closing& one) {
    return [&one](const closing& x) { return x.what.name == one.what.name; };
  };
  for (const auto& released : ends.released) {
    if (std::ranges::any_of(ends.violated, is_of(released)))
      continue;
    for (const auto& violated : ends.violated)
      found_({rule_of("C4"),
              fmt::format("{} of station {}, as {} ended",
                          released.what.name.view(), station,
                          violated.what.name.view()),
              released.step.at});
  }
}

void chain_rules::compare(const vehicle& of, const service& name,
                          const stage& before, const stage& next) {
  const auto who = fmt::format("{} of station {}", name.view(), of.station);
  if (next.result_of_none)
    found_({rule_of("C3"), who, *next.result_of_none});
  const auto tell_unanswered = [&](const made_step& result) {
    if (next.last > result.when + slack_) // else it may have died before
      found_({rule_of("C2"), "no input of " + who, result.at});
  };
  auto result = before.results.begin();
  for (const auto& input : next.inputs) {
    for (; result != before.results.end() && result->when + slack_ < input.when;
         ++result)
      tell_unanswered(*result);
    if (result == before.results.end() || result->when > input.when)
      found_({rule_of("C1"), who, input.at});
    else
      ++result;
  }
  for (; result != before.results.end(); ++result)
    tell_unanswered(*result);
}

void chain_rules::finish() {
  for (const auto& [of, ends] : ends_)
    compare(of.station, ends);
  for (const auto& [who, next] : stages_) {
    const auto& [of, name] = who;
    const auto before = chain_.find(name);
    if (before == chain_.end())
      continue;
    const auto found = stages_.find({of, before->second});
    if (found != stages_.end())
      compare(of, name, found->second, next);
  }
}

} // namespace sofof::experiments::conformance
