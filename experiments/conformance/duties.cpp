// Duties by name.
#include "experiments/conformance/duties.hpp"

#include <algorithm>
#include <utility>

namespace sofof::experiments::conformance {

void duties::owe(std::string name, time_point by, rule owed_by,
                 trace_place at) {
  owed_.insert_or_assign(std::move(name), duty{by, owed_by, at});
  soonest_ = std::min(soonest_, by);
}

void duties::pass(time_point now) {
  const auto due = now - slack_;
  if (due <= soonest_)
    return;
  soonest_ = time_point::max();
  for (auto i = owed_.begin(); i != owed_.end();) {
    if (i->second.by < due) {
      found_({i->second.owed_by, "not done: " + i->first, i->second.at});
      i = owed_.erase(i);
    } else {
      soonest_ = std::min(soonest_, i->second.by);
      ++i;
    }
  }
}

} // namespace sofof::experiments::conformance
