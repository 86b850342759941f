// Every figure under its name; the names are promises (docs/results.md).
#include "recording/summary.hpp"

#include "base/text/json.hpp"

namespace sofof {

namespace {

// Decimals of figures without a shortest unit of their own.
constexpr int second_places = 6;
constexpr int millisecond_places = 6;
constexpr int share_places = 6;
constexpr int places_of_margin = 4;
constexpr int motion_places = 6;
constexpr int octet_places = 3;
constexpr int energy_places = 6;
constexpr int wall_places = 3;

void mean_and_max(json_object& to, std::string_view name,
                  const statistics& figures) {
  auto object = to.object(name);
  object.member("mean", rounded(figures.mean(), second_places));
  object.member("max", rounded(figures.max(), second_places));
}

void distribution_of(json_object& to, std::string_view name,
                     const distribution& figures) {
  const auto ms = [](std::optional<double> x) {
    return rounded(x, millisecond_places);
  };
  auto object = to.object(name);
  object.member("count", figures.ms().count());
  object.member("mean", ms(figures.ms().mean()));
  object.member("std", ms(figures.ms().deviation()));
  object.member("p50", ms(figures.quantile_ms(0.5)));
  object.member("p95", ms(figures.quantile_ms(0.95)));
  object.member("p99", ms(figures.quantile_ms(0.99)));
  object.member("max", ms(figures.ms().max()));
}

void counts_and_times(json_object& to, const service_metrics& service,
                      const run_info& run, const run_end& end) {
  to.member("requests", service.requests());
  to.member("accepted", service.accepted);
  to.member("rejected", service.rejected);
  to.member("episodes", service.episodes);
  to.member("running_at_end", service.running_at_end);
  to.member("fallbacks", service.fallbacks);
  to.member("no_data", service.no_data);
  to.member("hand_overs", service.hand_overs);
  to.member("ping_pongs", service.ping_pongs);
  mean_and_max(to, "t_off_s", service.t_off_s);
  to.member("offloaded_share",
            rounded(service.offloaded_share(run.vehicles, end.virtual_s),
                    share_places));
  to.member("fairness", rounded(service.fairness(run.vehicles), share_places));
  to.member("results_used", service.results_used);
  distribution_of(to, "latency_ms", service.latency);
  distribution_of(to, "interarrival_ms", service.interarrival);
}

void endings(json_object& to, const end_counts& counts) {
  auto object = to.object("ended_by");
  for (std::size_t i = 0; i < end_reason_count; ++i)
    object.member(name_of(static_cast<end_reason>(i)), counts[i]);
}

/// Whose results were refused, by check.
void refusals(json_object& to, const refusal_counts& counts) {
  if (counts.empty())
    return;
  auto object = to.object("implausible");
  for (const auto& [provider, checks] : counts) {
    auto of = object.object(provider);
    for (const auto& [check, count] : checks)
      of.member(check, count);
  }
}

/// How near to a refusal the used results came.
void margins_of(json_object& to, const std::map<std::string, double>& least) {
  if (least.empty())
    return;
  auto object = to.object("margin");
  for (const auto& [name, left] : least)
    object.member(name, rounded(left, places_of_margin));
}

/// The provider's view.
void served(json_object& to, const service_metrics& service) {
  auto object = to.object("served");
  object.member("count", service.served_s.count());
  mean_and_max(object, "time_s", service.served_s);
  endings(object, service.served_until);
}

void safety_of(json_object& to, const safety_metrics& safety) {
  const auto recorded = safety.driven > duration::zero();
  auto object = to.object("safety");
  object.member("driven_s", seconds(safety.driven));
  object.member("without_fresh_plan_s", seconds(safety.without_fresh_plan));
  object.member("collisions", safety.collisions);
  object.member("near_misses", safety.near_misses);
  object.member("off_road_s", seconds(safety.off_road));
  object.member("max_plan_age_s",
                recorded ? seconds(safety.max_plan_age) : decimal{});
}

void cycles_of(json_object& to, const cycle_figures& x) {
  auto object = to.object("cycles");
  object.member("on_board", x.on_board);
  object.member("offloaded", x.offloaded);
  object.member("offloaded_share", rounded(x.offloaded_share(), share_places));
}

void energy_of(json_object& to, const cycle_figures& x, double distance_m) {
  constexpr auto m_per_km = 1e3;
  const auto recorded = x.all_on_board_j > 0;
  const auto joules = [recorded](double figure) {
    return recorded ? rounded(figure, energy_places) : decimal{};
  };
  auto object = to.object("energy");
  object.member("j", joules(x.energy_j()));
  object.member("local_j", joules(x.on_board_j));
  object.member("offloading_j", joules(x.offloaded_j));
  object.member("all_on_board_j", joules(x.all_on_board_j));
  object.member("per_km_j", distance_m > 0
                                ? joules(x.energy_j() * m_per_km / distance_m)
                                : decimal{});
  object.member("saved_share", rounded(x.saved_share(), share_places));
}

void switches_of(json_object& to, const switch_metrics& switches) {
  auto object = to.object("switch");
  object.member("count", switches.count());
  const auto jump = [&object](const statistics& x, std::string_view mean,
                              std::string_view max) {
    object.member(mean, rounded(x.mean(), motion_places));
    object.member(max, rounded(x.max(), motion_places));
  };
  jump(switches.d_m, "mean_d_m", "max_d_m");
  jump(switches.curvature_1pm, "mean_kappa_1pm", "max_kappa_1pm");
  jump(switches.speed_mps, "mean_v_mps", "max_v_mps");
  jump(switches.accel_mps2, "mean_a_mps2", "max_a_mps2");
}

void air_of(json_object& to, const air_metrics& air) {
  auto object = to.object("v2x");
  const auto count = [&object](std::string_view name, const air_count& x) {
    auto of = object.object(name);
    of.member("messages", x.messages);
    of.member("octets", x.octets);
    of.member("mean_octets", rounded(x.mean_octets(), octet_places));
  };
  count("cam", air.cam);
  count("cpm", air.cpm);
  count("mcm_up", air.mcm_up);
  count("mcm_down", air.mcm_down);
}

void extremes_of(json_object& to, const motion_extremes& x, bool recorded) {
  const auto member = [&](std::string_view name, double figure) {
    to.member(name, recorded ? rounded(figure, motion_places) : decimal{});
  };
  member("max_lateral_accel_mps2", x.lateral_accel_mps2);
  member("max_jerk_mps3", x.jerk_mps3);
  member("min_accel_mps2", x.min_accel_mps2);
}

void plans_of(json_object& to, const plan_figures& plans) {
  auto object = to.object("plans");
  object.member("count", plans.count);
  object.member("emergency", plans.emergency);
  object.member("kept", plans.kept);
  object.member("stops", plans.stops);
  object.member("imperfect", plans.imperfect);
  object.member("safe_stops", plans.safe_stops);
  extremes_of(object, plans.extremes, plans.count > plans.emergency);
}

void driving_of(json_object& to, const drive_metrics& drive) {
  auto object = to.object("driving");
  object.member("distance_m", rounded(drive.ride.distance_m, motion_places));
  extremes_of(object, drive.ride.extremes,
              drive.safety.driven > duration::zero());
  object.member("hard_brakes", drive.ride.hard_brakes);
  object.member("comfort_cost_m2ps3",
                rounded(drive.ride.comfort_cost_m2ps3, motion_places));
}

void timing_of(json_object& to, const run_end& end) {
  auto object = to.object("timing");
  object.member("wall_s", rounded(end.wall_s, wall_places));
  object.member("x_real_time", rounded(end.x_real_time(), wall_places));
}

} // namespace

std::string summary_json(const metrics& m, const run_info& run,
                         const run_end& end) {
  std::string text;
  {
    json_object top{text, json_object::layout::lines};
    top.member("version", run.version);
    top.member("scenario", run.scenario);
    top.member("clock", run.clock);
    top.member("profile", run.profile);
    top.member("lodm", run.lodm);
    top.member("codm", run.codm);
    top.member("seed", decimal{run.seed});
    top.member("virtual_s", rounded(end.virtual_s, second_places));
    top.member("interrupted", end.interrupted);
    top.member("vehicles", run.vehicles);
    top.member("offers", m.offers());
    counts_and_times(top, m.headline(), run, end);
    safety_of(top, m.safety());
    plans_of(top, m.together().plans);
    driving_of(top, m.together());
    cycles_of(top, m.cycles());
    energy_of(top, m.cycles(), m.together().ride.distance_m);
    switches_of(top, m.switches());
    air_of(top, m.air());
    endings(top, m.headline().ended_by);
    {
      auto services = top.object("services");
      for (const auto& service : m.services()) {
        auto object = services.object(service.kind.view());
        counts_and_times(object, service, run, end);
        endings(object, service.ended_by);
        refusals(object, service.implausible);
        margins_of(object, service.margins);
        served(object, service);
      }
    }
    timing_of(top, end);
    top.member("wall_s", rounded(end.wall_s, wall_places));
  }
  text += '\n';
  return text;
}

} // namespace sofof
