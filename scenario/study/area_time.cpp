// In and out again, vehicle by vehicle.
#include "scenario/study/area_time.hpp"

#include "scenario/load.hpp"
#include "scenario/report/run_files.hpp"
#include "world/geometry.hpp"

#include <cstdint>
#include <map>

namespace sofof::study {

std::optional<double> mean_time_in_area_s(const measured_run& run) {
  const auto what = load_scenario(run.folder / "config.toml");
  const auto area = what.providers.at(0).area();
  const auto tracks = report::read_tracks(run.folder);
  if (!tracks)
    return std::nullopt;
  struct whereabouts {
    bool inside = false;
    std::optional<double> entered_s; ///< Nothing for who started inside.
  };
  std::map<std::uint64_t, whereabouts> vehicles;
  group stays;
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
  if (stays.count == 0)
    return std::nullopt;
  return stays.sum / stays.count;
}

} // namespace sofof::study
