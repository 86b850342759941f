// Steps by name, as often as they are made.
#include "experiments/conformance/vehicle_rules.hpp"

#include "experiments/conformance/names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::experiments::conformance {

namespace {

using messages::trace_part;
using messages::trace_step;

/// A step of a requester and that of the selector.
struct step_of_both {
  trace_step decided;
  trace_step done;
  std::string_view what;
};

constexpr step_of_both steps_of_both[]{
    {trace_step::begun, trace_step::begun, "the begin of"},
    {trace_step::closed, trace_step::end_got, "the end of"},
    {trace_step::standby, trace_step::standby, "who stands by:"},
};

} // namespace

void vehicle_rules::add(const messages::trace_record& x, trace_place at) {
  if (x.by == trace_part::provider)
    return;
  const auto by = x.by == trace_part::selector ? selector : requester;
  part of{at.trace, x.station, {}};
  if (by == requester)
    last_[of] = x.at;
  if (x.services.empty())
    return;
  of.service = x.services.front().name;
  if (by == selector)
    last_[of] = x.at;
  const auto* kind = std::ranges::find(steps_of_both, x.what,
                                       by == selector ? &step_of_both::done
                                                      : &step_of_both::decided);
  if (kind == std::end(steps_of_both))
    return;
  auto name = fmt::format("{}: {} {}, {} ns", at.trace, kind->what,
                          session_in(x), x.number);
  name += fmt::format(", for the {}. time", ++times_[std::pair{by, name}]);
  auto& common = steps_[name];
  common.of = of;
  common.by[by] = {x.at, at};
}

void vehicle_rules::finish() {
  for (const auto& [name, x] : steps_)
    for (const auto by : {requester, selector}) {
      if (!x.by[by] || x.by[1 - by])
        continue;
      auto other = x.of;
      if (by == selector)
        other.service = {};
      const auto last = last_.find(other);
      if (last != last_.end() && last->second > x.by[by]->when + slack_)
        found_({rule_of("M3"),
                fmt::format("{}: only the {}", name,
                            by == selector ? "selector" : "requester"),
                x.by[by]->at});
    }
}

} // namespace sofof::experiments::conformance
