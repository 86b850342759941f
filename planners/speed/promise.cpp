// A drive that others rely on, as bounds of a speed plan.
#include "planners/speed/promise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace sofof::planners {

namespace {

/// Who is late catches up to 1/e of it within this.
constexpr double catches_up_s = 3;

/// @returns when to be there; before the first place as if it went on so from
/// before.
std::optional<double> agreed_s(const speed_constraints& task, double way_m) {
  const auto& all = task.promised;
  if (all.size() < 2 || way_m >= all[0].at_m)
    return task.promised_s(way_m);
  const auto pace =
      (all[1].time_s - all[0].time_s) / (all[1].at_m - all[0].at_m);
  return all[0].time_s - pace * (all[0].at_m - way_m);
}

} // namespace

void bound_by_promise(const speed_constraints& task, double from_m, double ds_m,
                      std::span<double> earliest, std::span<double> latest,
                      std::span<double> promised) {
  constexpr auto never = speed_constraints::never;
  assert(ds_m > 0 && earliest.size() == latest.size());
  assert(promised.size() == earliest.size());
  std::ranges::fill(promised, never);
  if (task.promised.empty())
    return;
  const auto own_s = agreed_s(task, from_m);
  const auto late_s = own_s ? -*own_s : 0;
  auto last_s = never;
  for (std::size_t k = 0; k < promised.size(); ++k) {
    const auto way_m = from_m + static_cast<double>(k) * ds_m;
    const auto t = agreed_s(task, way_m);
    if (t && way_m >= task.promised_from_m) {
      earliest[k] = std::max(earliest[k], *t - task.sooner_s);
      latest[k] = std::min(latest[k], *t + task.later_s);
    }
    const auto aims_s =
        t ? *t + late_s * std::exp(-(*t + late_s) / catches_up_s) : never;
    if (aims_s < never && aims_s > last_s) {
      const auto v = ds_m / (aims_s - last_s);
      promised[k] = v * v / 2;
    }
    last_s = aims_s;
  }
}

} // namespace sofof::planners
