// A drive that others rely on, as bounds of a speed plan.
#include "planners/speed/promise.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::planners {

void bound_by_promise(const speed_constraints& task, double from_m, double ds_m,
                      std::span<double> earliest, std::span<double> latest,
                      std::span<double> promised) {
  constexpr auto never = speed_constraints::never;
  assert(ds_m > 0 && earliest.size() == latest.size());
  assert(promised.size() == earliest.size());
  std::ranges::fill(promised, never);
  if (task.promised.empty())
    return;
  auto last_s = never;
  for (std::size_t k = 0; k < promised.size(); ++k) {
    const auto way_m = from_m + static_cast<double>(k) * ds_m;
    const auto t = task.promised_s(way_m);
    if (t && way_m >= task.promised_from_m) {
      earliest[k] = std::max(earliest[k], *t - task.sooner_s);
      latest[k] = std::min(latest[k], *t + task.later_s);
    }
    if (t && *t > last_s) {
      const auto v = ds_m / (*t - last_s);
      promised[k] = v * v / 2;
    }
    last_s = t.value_or(never);
  }
}

} // namespace sofof::planners
