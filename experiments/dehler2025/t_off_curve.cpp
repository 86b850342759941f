// Offloading time against the longest gap that is allowed, as a curve.
#include "experiments/dehler2025/t_off_curve.hpp"

#include "experiments/dehler2025/offloading_time.hpp"
#include "experiments/dehler2025/paper_figures.hpp"

#include <limits>
#include <utility>

namespace sofof::experiments::study {

std::string count_of_vehicles(const std::string& vehicles) {
  return vehicles == "1" ? "1 vehicle" : vehicles + " vehicles";
}

report::curve t_off_curve(std::span<const measured_run> runs,
                          const std::string& vehicles,
                          const std::string& name) {
  report::curve c;
  c.name = name;
  for (const auto& gap : labels_of(runs, 1)) {
    const auto t = mean_t_off(those(runs, vehicles, gap));
    constexpr auto none = std::numeric_limits<double>::quiet_NaN();
    c.x.push_back(ms_of(gap));
    c.y.push_back(t ? t->mean : none);
    c.low.push_back(t ? t->low : none);
    c.high.push_back(t ? t->high : none);
  }
  return c;
}

report::figure t_off_figure(std::string title) {
  report::figure f;
  f.title = std::move(title);
  f.x_label = "Δt_max, ms";
  f.y_label = "t_off per accepted request, s";
  return f;
}

} // namespace sofof::experiments::study
