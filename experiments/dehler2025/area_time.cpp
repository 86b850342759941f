// In and out again, vehicle by vehicle.
#include "experiments/dehler2025/area_time.hpp"

#include "base/geometry.hpp"
#include "base/options/toml_file.hpp"
#include "experiments/dehler2025/interval.hpp"
#include "experiments/report/run_files.hpp"
#include "scenario/load.hpp"

#include <cstdint>
#include <map>

namespace sofof::experiments::study {

namespace {

/// How long each stay of a run was, added up.
group stays_in_area(const measured_run& run) {
  const auto config = run.folder / "config.toml";
  const auto what = scenario::parse_scenario(require_text(config), config);
  const auto area = what.providers.at(0).area();
  struct whereabouts {
    bool inside = false;
    std::optional<double> entered_s; ///< Nothing for who started inside.
  };
  std::map<std::uint64_t, whereabouts> vehicles;
  group stays;
  const auto tracks = report::read_tracks(run.folder);
  if (!tracks)
    return stays;
  for (const auto& line : *tracks) {
    const auto inside = area.contains({line.x_m, line.y_m});
    const auto [at, is_new] = vehicles.try_emplace(line.station);
    auto& v = at->second;
    if (inside && !v.inside && !is_new)
      v.entered_s = line.t_s;
    if (!inside && v.inside && v.entered_s) {
      stays.sum += line.t_s - *v.entered_s;
      ++stays.count;
    }
    v.inside = inside;
  }
  return stays;
}

} // namespace

std::optional<double>
mean_time_in_area_s(std::span<const measured_run* const> runs) {
  group all;
  for (const auto* run : runs) {
    const auto stays = stays_in_area(*run);
    all.sum += stays.sum;
    all.count += stays.count;
  }
  if (all.count == 0)
    return std::nullopt;
  return all.sum / all.count;
}

} // namespace sofof::experiments::study
