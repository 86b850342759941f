// Every figure under its name; the names are promises (docs/results.md).
#include "recording/figures.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sofof::recording {

namespace {

// Decimals of figures in the summary.
constexpr int second_places = 6;
constexpr int ms_places = 6;
constexpr int share_places = 6;
constexpr int motion_places = 6;
constexpr int octet_places = 3;
constexpr int wall_places = 3;

constexpr double as_percent = 100;
constexpr double ms_per_s = 1000;
constexpr double km_per_m = 1e-3;
constexpr double mb_per_octet = 1e-6;

template <class T>
std::optional<T> only_if(bool known, T x) {
  return known ? std::optional{x} : std::nullopt;
}

template <class T>
std::optional<T> if_driven(const whole_run& x, T value) {
  return only_if(x.of.safety().driven > duration::zero(), value);
}

std::optional<double> if_planned(const whole_run& x, double value) {
  const auto& plans = x.of.together().plans;
  return only_if(plans.count > plans.emergency, value);
}

/// Of routes that lead round there is no end to arrive at.
std::optional<double> arrived_per_h(const whole_run& x) {
  constexpr double s_per_h = 3600;
  const auto count = static_cast<double>(x.of.traffic().arrived());
  return only_if(count > 0 && x.end.virtual_s > 0,
                 s_per_h * count / x.end.virtual_s);
}

// Only modelled cells count what they carry.
std::optional<double> if_sent(const service_in_run& x, std::uint64_t octets) {
  return only_if(x.of.octets_up + x.of.octets_down > 0,
                 static_cast<double>(octets));
}

std::string latency_and_deviation(const service_in_run& x) {
  const auto& ms = x.of.latency.ms();
  if (!ms.mean())
    return "-";
  if (!ms.deviation())
    return fmt::format("{:.2f} ms", *ms.mean());
  return fmt::format("{:.2f} ± {:.2f} ms", *ms.mean(), *ms.deviation());
}

constexpr run_figure of_run[]{
    {"virtual_s",
     second_places,
     [](const auto& x) { return x.end.virtual_s; },
     {report_table::run, 10, "length, s", 1}},
    {"interrupted", 0, [](const auto& x) { return x.end.interrupted; }},
    {"vehicles",
     0,
     [](const auto& x) { return x.run.vehicles; },
     {report_table::run, 20, "vehicles"}},
    {"offers",
     0,
     [](const auto& x) { return x.of.offers(); },
     {report_table::run, 30, "offers"}},
};

constexpr service_figure of_service[]{
    {"requests",
     0,
     [](const auto& x) { return x.of.requests(); },
     {report_table::service, 10, "requests"},
     {console_block::asked, 10, "requests"}},
    {"accepted",
     0,
     [](const auto& x) { return x.of.accepted; },
     {report_table::service, 20, "accepted"},
     {console_block::asked, 20, "accepted"}},
    {"rejected",
     0,
     [](const auto& x) { return x.of.rejected; },
     {report_table::service, 30, "rejected"},
     {console_block::asked, 30, "rejected"}},
    {"episodes",
     0,
     [](const auto& x) { return x.of.episodes; },
     {report_table::service, 50, "episodes"},
     {console_block::asked, 50, "episodes"}},
    {"running_at_end", 0, [](const auto& x) { return x.of.running_at_end; }},
    {"fallbacks",
     0,
     [](const auto& x) { return x.of.fallbacks; },
     {report_table::service, 60, "fallbacks"},
     {console_block::offloaded, 10, "fallbacks"}},
    {"no_data",
     0,
     [](const auto& x) { return x.of.no_data; },
     {report_table::service, 40, "accepted, but no result came"},
     {console_block::asked, 40, "no data"}},
    {"hand_overs", 0, [](const auto& x) { return x.of.hand_overs; }},
    {"ping_pongs", 0, [](const auto& x) { return x.of.ping_pongs; }},
    {"t_off_s.mean",
     second_places,
     [](const auto& x) { return x.of.t_off_s.mean(); },
     {report_table::service, 70, "offloading time, mean, s", 2},
     {console_block::offloaded, 20, "t_off mean", 2, "s"}},
    {"t_off_s.max",
     second_places,
     [](const auto& x) { return x.of.t_off_s.max(); },
     {report_table::service, 80, "offloading time, longest, s", 2},
     {console_block::offloaded, 30, "t_off max", 2, "s"}},
    {"offloaded_share",
     share_places,
     [](const auto& x) { return x.of.offloaded_share(x.all.safety().driven); },
     {report_table::service, 90, "offloaded share, %", 1, as_percent},
     {console_block::offloaded, 40, "offloaded share", 1, "%", as_percent}},
    {"fairness", share_places,
     [](const auto& x) { return x.of.fairness(x.run.vehicles); }},
    {"results_used",
     0,
     [](const auto& x) { return x.of.results_used; },
     {report_table::service, 110, "remote results used"},
     {console_block::results, 20, "used"}},
    {"latency_ms.count",
     0,
     [](const auto& x) { return x.of.latency.ms().count(); },
     {report_table::service, 100, "remote results"},
     {console_block::results, 10, "received"}},
    {"latency_ms.mean",
     ms_places,
     [](const auto& x) { return x.of.latency.ms().mean(); },
     {report_table::service, 120, "latency, mean, ms", 2},
     {console_block::results, 30, "latency", 2, "ms", 1,
      latency_and_deviation}},
    {"latency_ms.std",
     ms_places,
     [](const auto& x) { return x.of.latency.ms().deviation(); },
     {report_table::service, 130, "latency, standard deviation, ms", 2}},
    {"latency_ms.p50",
     ms_places,
     [](const auto& x) { return x.of.latency.quantile_ms(0.5); },
     {report_table::service, 140, "latency, median, ms", 2},
     {console_block::results, 40, "  p50", 2, "ms"}},
    {"latency_ms.p95", ms_places,
     [](const auto& x) { return x.of.latency.quantile_ms(0.95); }},
    {"latency_ms.p99",
     ms_places,
     [](const auto& x) { return x.of.latency.quantile_ms(0.99); },
     {report_table::service, 150, "latency, 99 %, ms", 2},
     {console_block::results, 50, "  p99", 2, "ms"}},
    {"latency_ms.max",
     ms_places,
     [](const auto& x) { return x.of.latency.ms().max(); },
     {report_table::service, 160, "latency, longest, ms", 2},
     {console_block::results, 60, "  max", 2, "ms"}},
    {"input_age_ms.mean",
     ms_places,
     [](const auto& x) { return x.of.input_age.ms().mean(); },
     {report_table::service, 162, "age of the input, mean, ms", 2},
     {console_block::results, 62, "age of input", 2, "ms"}},
    {"input_age_ms.std", ms_places,
     [](const auto& x) { return x.of.input_age.ms().deviation(); }},
    {"input_age_ms.p50", ms_places,
     [](const auto& x) { return x.of.input_age.quantile_ms(0.5); }},
    {"input_age_ms.p95", ms_places,
     [](const auto& x) { return x.of.input_age.quantile_ms(0.95); }},
    {"input_age_ms.p99",
     ms_places,
     [](const auto& x) { return x.of.input_age.quantile_ms(0.99); },
     {report_table::service, 164, "age of the input, 99 %, ms", 2},
     {console_block::results, 64, "  p99", 2, "ms"}},
    {"input_age_ms.max",
     ms_places,
     [](const auto& x) { return x.of.input_age.ms().max(); },
     {report_table::service, 166, "age of the input, largest, ms", 2},
     {console_block::results, 66, "  max", 2, "ms"}},
    {"octets.up",
     0,
     [](const auto& x) { return if_sent(x, x.of.octets_up); },
     {report_table::service, 192, "sent up, MB", 3, mb_per_octet},
     {console_block::results, 92, "sent up", 3, "MB", mb_per_octet}},
    {"octets.down",
     0,
     [](const auto& x) { return if_sent(x, x.of.octets_down); },
     {report_table::service, 194, "sent down, MB", 3, mb_per_octet},
     {console_block::results, 94, "sent down", 3, "MB", mb_per_octet}},
    {"interarrival_ms.count", 0,
     [](const auto& x) { return x.of.interarrival.ms().count(); }},
    {"interarrival_ms.mean",
     ms_places,
     [](const auto& x) { return x.of.interarrival.ms().mean(); },
     {report_table::service, 170, "inter-arrival time, mean, ms", 2},
     {console_block::results, 70, "inter-arrival", 2, "ms"}},
    {"interarrival_ms.std", ms_places,
     [](const auto& x) { return x.of.interarrival.ms().deviation(); }},
    {"interarrival_ms.p50", ms_places,
     [](const auto& x) { return x.of.interarrival.quantile_ms(0.5); }},
    {"interarrival_ms.p95", ms_places,
     [](const auto& x) { return x.of.interarrival.quantile_ms(0.95); }},
    {"interarrival_ms.p99",
     ms_places,
     [](const auto& x) { return x.of.interarrival.quantile_ms(0.99); },
     {report_table::service, 180, "inter-arrival time, 99 %, ms", 2},
     {console_block::results, 80, "  p99", 2, "ms"}},
    {"interarrival_ms.max",
     ms_places,
     [](const auto& x) { return x.of.interarrival.ms().max(); },
     {report_table::service, 190, "inter-arrival time, longest, ms", 2},
     {console_block::results, 90, "  max", 2, "ms"}},
};

constexpr service_figure of_served[]{
    {"served.count",
     0,
     [](const auto& x) { return x.of.served_s.count(); },
     {report_table::service, 200, "served by providers"},
     {console_block::provided, 10, "services run"}},
    {"served.time_s.mean",
     second_places,
     [](const auto& x) { return x.of.served_s.mean(); },
     {report_table::service, 210, "served, mean, s", 2},
     {console_block::provided_time, 20, "time mean", 2, "s"}},
    {"served.time_s.max",
     second_places,
     [](const auto& x) { return x.of.served_s.max(); },
     {},
     {console_block::provided_time, 30, "time max", 2, "s"}},
};

constexpr run_figure of_vehicles[]{
    {"safety.driven_s", 0, [](const auto& x) { return x.of.safety().driven; }},
    {"safety.without_fresh_plan_s",
     0,
     [](const auto& x) { return x.of.safety().without_fresh_plan; },
     {report_table::safety, 10, "without a fresh plan, s", 3},
     {console_block::safety, 10, "without a fresh plan", 3, "s"}},
    {"safety.collisions",
     0,
     [](const auto& x) { return x.of.safety().collisions; },
     {report_table::safety, 30, "collisions"},
     {console_block::safety, 30, "collisions"}},
    {"safety.near_misses",
     0,
     [](const auto& x) { return x.of.safety().near_misses; },
     {report_table::safety, 35, "near misses"},
     {console_block::safety, 35, "near misses"}},
    {"safety.off_road_s",
     0,
     [](const auto& x) { return x.of.safety().off_road; },
     {report_table::safety, 20, "off the road, s", 3},
     {console_block::safety, 20, "off the road", 3, "s"}},
    {"safety.max_plan_age_s",
     0,
     [](const auto& x) { return if_driven(x, x.of.safety().max_plan_age); },
     {report_table::safety, 40, "oldest plan in use, ms", 1, ms_per_s},
     {console_block::safety, 40, "oldest plan in use", 3, "s"}},
    {"plans.count",
     0,
     [](const auto& x) { return x.of.together().plans.count; },
     {report_table::safety, 50, "plans"}},
    {"plans.emergency",
     0,
     [](const auto& x) { return x.of.together().plans.emergency; },
     {report_table::safety, 60, "emergency plans"},
     {console_block::comfort, 40, "emergency plans"}},
    {"plans.kept", 0, [](const auto& x) { return x.of.together().plans.kept; }},
    {"plans.stops", 0,
     [](const auto& x) { return x.of.together().plans.stops; }},
    {"plans.imperfect", 0,
     [](const auto& x) { return x.of.together().plans.imperfect; }},
    {"plans.safe_stops",
     0,
     [](const auto& x) { return x.of.together().plans.safe_stops; },
     {report_table::safety, 70, "safe stops"}},
    {"plans.max_lateral_accel_mps2", motion_places,
     [](const auto& x) {
       return if_planned(x, x.of.together().plans.extremes.lateral_accel_mps2);
     }},
    {"plans.max_jerk_mps3", motion_places,
     [](const auto& x) {
       return if_planned(x, x.of.together().plans.extremes.jerk_mps3);
     }},
    {"plans.min_accel_mps2", motion_places,
     [](const auto& x) {
       return if_planned(x, x.of.together().plans.extremes.min_accel_mps2);
     }},
    {"driving.distance_m",
     motion_places,
     [](const auto& x) { return x.of.together().ride.distance_m; },
     {report_table::safety, 80, "way driven, km", 2, km_per_m}},
    {"driving.max_lateral_accel_mps2",
     motion_places,
     [](const auto& x) {
       return if_driven(x, x.of.together().ride.extremes.lateral_accel_mps2);
     },
     {report_table::safety, 90, "lateral acceleration, largest, m/s²", 2},
     {console_block::comfort, 10, "lateral acceleration", 2, "m/s²"}},
    {"driving.max_jerk_mps3",
     motion_places,
     [](const auto& x) {
       return if_driven(x, x.of.together().ride.extremes.jerk_mps3);
     },
     {report_table::safety, 100, "jerk, largest, m/s³", 2},
     {console_block::comfort, 20, "jerk", 2, "m/s³"}},
    {"driving.min_accel_mps2",
     motion_places,
     [](const auto& x) {
       return if_driven(x, x.of.together().ride.extremes.min_accel_mps2);
     },
     {report_table::safety, 110, "acceleration, lowest, m/s²", 2}},
    {"driving.hard_brakes",
     0,
     [](const auto& x) { return x.of.together().ride.hard_brakes; },
     {report_table::safety, 120, "hard brakes"},
     {console_block::comfort, 30, "hard brakes"}},
    {"driving.comfort_cost_m2ps3",
     motion_places,
     [](const auto& x) { return x.of.together().ride.comfort_cost_m2ps3; },
     {report_table::safety, 130, "comfort cost, m²/s³", 1}},
    {"traffic.delay_s.mean",
     second_places,
     [](const auto& x) { return x.of.traffic().delay_s().mean(); },
     {report_table::traffic, 10, "delay, mean, s", 1},
     {console_block::traffic, 10, "delay", 1, "s"}},
    {"traffic.delay_s.p95",
     second_places,
     [](const auto& x) { return x.of.traffic().delay_s(0.95); },
     {report_table::traffic, 20, "delay, 95 %, s", 1},
     {console_block::traffic, 20, "  p95", 1, "s"}},
    {"traffic.delay_s.max",
     second_places,
     [](const auto& x) { return x.of.traffic().delay_s().max(); },
     {report_table::traffic, 30, "delay, longest, s", 1},
     {console_block::traffic, 30, "  max", 1, "s"}},
    {"traffic.stops",
     0,
     [](const auto& x) { return x.of.traffic().stops(); },
     {report_table::traffic, 40, "stops"},
     {console_block::traffic, 40, "stops"}},
    {"traffic.longest_stop_s",
     second_places,
     [](const auto& x) { return x.of.traffic().longest_stop_s(); },
     {report_table::traffic, 50, "longest stop, s", 1},
     {console_block::traffic, 50, "longest stop", 1, "s"}},
    {"traffic.arrived",
     0,
     [](const auto& x) { return x.of.traffic().arrived(); },
     {report_table::traffic, 60, "vehicles that arrived"}},
    {"traffic.arrived_per_h",
     second_places,
     [](const auto& x) { return arrived_per_h(x); },
     {report_table::traffic, 70, "vehicles that arrived, per hour", 0}},
    {"cycles.on_board", 0,
     [](const auto& x) { return x.of.cycles().on_board; }},
    {"cycles.offloaded", 0,
     [](const auto& x) { return x.of.cycles().offloaded; }},
    {"cycles.offloaded_share", share_places,
     [](const auto& x) { return x.of.cycles().offloaded_share(); }},
    {"switch.count",
     0,
     [](const auto& x) { return x.of.switches().count(); },
     {report_table::safety, 160, "changes of the plan's source"}},
    {"switch.mean_d_m", motion_places,
     [](const auto& x) { return x.of.switches().d_m.mean(); }},
    {"switch.max_d_m",
     motion_places,
     [](const auto& x) { return x.of.switches().d_m.max(); },
     {report_table::safety, 170, "jump at a change, largest, m", 3}},
    {"switch.mean_kappa_1pm", motion_places,
     [](const auto& x) { return x.of.switches().curvature_1pm.mean(); }},
    {"switch.max_kappa_1pm", motion_places,
     [](const auto& x) { return x.of.switches().curvature_1pm.max(); }},
    {"switch.mean_v_mps", motion_places,
     [](const auto& x) { return x.of.switches().speed_mps.mean(); }},
    {"switch.max_v_mps", motion_places,
     [](const auto& x) { return x.of.switches().speed_mps.max(); }},
    {"switch.mean_a_mps2", motion_places,
     [](const auto& x) { return x.of.switches().accel_mps2.mean(); }},
    {"switch.max_a_mps2", motion_places,
     [](const auto& x) { return x.of.switches().accel_mps2.max(); }},
    {"v2x.cam.messages",
     0,
     [](const auto& x) { return x.of.air().cam.messages; },
     {report_table::air, 10, "CAMs"}},
    {"v2x.cam.octets", 0, [](const auto& x) { return x.of.air().cam.octets; }},
    {"v2x.cam.mean_octets",
     octet_places,
     [](const auto& x) { return x.of.air().cam.mean_octets(); },
     {report_table::air, 20, "CAM, mean octets", 1}},
    {"v2x.cpm.messages",
     0,
     [](const auto& x) { return x.of.air().cpm.messages; },
     {report_table::air, 30, "CPMs"}},
    {"v2x.cpm.octets", 0, [](const auto& x) { return x.of.air().cpm.octets; }},
    {"v2x.cpm.mean_octets",
     octet_places,
     [](const auto& x) { return x.of.air().cpm.mean_octets(); },
     {report_table::air, 40, "CPM, mean octets", 1}},
    {"v2x.mcm_up.messages",
     0,
     [](const auto& x) { return x.of.air().mcm_up.messages; },
     {report_table::air, 50, "MCMs up"}},
    {"v2x.mcm_up.octets", 0,
     [](const auto& x) { return x.of.air().mcm_up.octets; }},
    {"v2x.mcm_up.mean_octets",
     octet_places,
     [](const auto& x) { return x.of.air().mcm_up.mean_octets(); },
     {report_table::air, 60, "MCM up, mean octets", 1}},
    {"v2x.mcm_down.messages",
     0,
     [](const auto& x) { return x.of.air().mcm_down.messages; },
     {report_table::air, 70, "MCMs down"}},
    {"v2x.mcm_down.octets", 0,
     [](const auto& x) { return x.of.air().mcm_down.octets; }},
    {"v2x.mcm_down.mean_octets",
     octet_places,
     [](const auto& x) { return x.of.air().mcm_down.mean_octets(); },
     {report_table::air, 80, "MCM down, mean octets", 1}},
};

constexpr run_figure of_clock[]{
    {"timing.wall_s",
     wall_places,
     [](const auto& x) { return x.end.wall_s; },
     {report_table::run, 40, "computed in, s", 1}},
    {"timing.x_real_time",
     wall_places,
     [](const auto& x) { return x.end.x_real_time(); },
     {report_table::run, 50, "times real time", 1}},
    {"timing.stood_still_s",
     wall_places,
     [](const auto& x) { return to_seconds(x.end.stood_still.together); },
     {report_table::run, 60, "the machine stood still, s", 3}},
    {"wall_s", wall_places, [](const auto& x) { return x.end.wall_s; }},
};

template <class Of>
void report(std::vector<reported_figure>& to, report_table table,
            std::span<const figure<Of>> figures) {
  for (const auto& x : figures)
    if (x.report.in == table)
      to.push_back({x.name, x.report});
}

} // namespace

std::span<const run_figure> run_figures() {
  return of_run;
}

std::span<const service_figure> service_figures() {
  return of_service;
}

std::span<const service_figure> served_figures() {
  return of_served;
}

std::span<const run_figure> vehicle_figures() {
  return of_vehicles;
}

std::span<const run_figure> clock_figures() {
  return of_clock;
}

std::vector<reported_figure> reported_in(report_table table) {
  std::vector<reported_figure> all;
  report(all, table, run_figures());
  report(all, table, service_figures());
  report(all, table, served_figures());
  report(all, table, service_cost_figures());
  report(all, table, vehicle_figures());
  report(all, table, run_cost_figures());
  report(all, table, clock_figures());
  std::ranges::sort(all, {}, [](const auto& x) { return x.how.place; });
  return all;
}

} // namespace sofof::recording
