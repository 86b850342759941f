// Practice problems as JSON.
#include "experiments/solve/practice_file.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "planners/problems/sample_problems.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace sofof::experiments {

namespace {

using nlohmann::ordered_json;

// JSON has no infinity: null is no bound.
ordered_json bounds(std::span<const double> values) {
  ordered_json list = ordered_json::array();
  for (const auto x : values)
    list.push_back(std::isfinite(x) ? ordered_json(x) : ordered_json());
  return list;
}

ordered_json numbers(std::span<const double> values) {
  return std::vector<double>(values.begin(), values.end());
}

ordered_json as_json(const planners::path_problem& p) {
  ordered_json lo = ordered_json::array(), hi = ordered_json::array();
  for (std::size_t k = 0; k < p.wanted_m.size(); ++k) {
    ordered_json low = ordered_json::array(), high = ordered_json::array();
    for (const auto& disc : p.discs) {
      low.push_back(disc.lo_m[k]);
      high.push_back(disc.hi_m[k]);
    }
    lo.push_back(low);
    hi.push_back(high);
  }
  return {{"x0", {p.start.d_m, p.start.heading_rad, p.start.curvature_1pm}},
          {"kappa_ref", numbers(p.curvature_1pm)},
          {"d_ref", numbers(p.wanted_m)},
          {"lo", lo},
          {"hi", hi}};
}

ordered_json as_json(const planners::velocity_problem& p) {
  const auto& l = p.limits;
  return {{"x0", {p.start.t_s, p.start.w_m2ps2, p.start.accel_mps2}},
          {"limits",
           {{"a_min", l.accel_min_mps2},
            {"a_max", l.accel_max_mps2},
            {"j_max", l.jerk_max_mps3},
            {"a_tot", l.total_max_mps2}}},
          {"k_stop", p.stop_knot ? ordered_json(*p.stop_knot) : ordered_json()},
          {"w_max", numbers(p.w_max_m2ps2)},
          {"w_ref", numbers(p.wanted_m2ps2)},
          {"kappa", numbers(p.curvature_1pm)},
          {"t_lo", bounds(p.earliest_s)},
          {"t_hi", bounds(p.latest_s)}};
}

ordered_json path_drive() {
  constexpr auto drive = 120;
  planners::slalom road;
  const auto solver = std::make_unique<planners::path_ocp>();
  planners::path_state x;
  ordered_json file{{"problem", "path"}};
  ordered_json list = ordered_json::array();
  for (int k = 0; k < drive; ++k) {
    const auto& p = road.at(k, x);
    if (k == 0) {
      ordered_json ahead = ordered_json::array();
      for (const auto& disc : p.discs)
        ahead.push_back(disc.ahead_m);
      const auto& w = p.weights;
      file.update({{"N", p.steps},
                   {"ds_m", p.ds_m},
                   {"disc_offsets_m", ahead},
                   {"curvature_max", p.curvature_max_1pm},
                   {"curvature_rate_max", p.rate_max_1pm2},
                   {"weights",
                    {{"d", w.offset},
                     {"theta", w.heading},
                     {"kappa", w.curvature},
                     {"u", w.rate},
                     {"terminal_factor", w.end_factor}}}});
    }
    list.push_back(as_json(p));
    solver->shift(k > 0 ? 1 : 0);
    solver->solve(p, planners::ocp::start::warm);
    // Noise that repeats without a generator: a slow wobble.
    const auto noise = std::sin(2.4 * k);
    x = {solver->offset_m()[1] + 0.02 * noise,
         solver->heading_rad()[1] + 2e-3 * noise,
         solver->curvature_1pm()[1] - 3e-4 * noise};
  }
  file["instances"] = list;
  return file;
}

ordered_json velocity_drives() {
  using event = planners::practice_road::event;
  constexpr auto steps = 30, stride = 2;
  ordered_json file{{"problem", "velocity"}};
  ordered_json list = ordered_json::array();
  const auto solver = std::make_unique<planners::velocity_ocp>();
  for (const auto what : {event::free_flow, event::slow_leader,
                          event::stop_line, event::crossing}) {
    planners::practice_road road{what};
    planners::velocity_state x{.t_s = 0, .w_m2ps2 = 60, .accel_mps2 = 0};
    auto now_s = 0.;
    for (int step = 0; step < steps; ++step) {
      const auto& p = road.at(stride * step, now_s, x);
      const auto& w = p.weights;
      if (list.empty())
        file.update({{"N", p.steps},
                     {"ds_m", p.ds_m},
                     {"eps_mps", planners::ocp::crawl_mps},
                     {"k_a_tot", p.limits.total_from},
                     {"weights",
                      {{"v", w.speed},
                       {"a", w.accel},
                       {"j", w.jerk},
                       {"terminal_m", w.end_m}}}});
      auto instance = as_json(p);
      instance["step"] = step;
      instance["continues"] = step > 0;
      list.push_back(instance);
      solver->shift(step > 0 ? stride : 0);
      solver->solve(p, step > 0 ? planners::ocp::start::warm
                                : planners::ocp::start::cold);
      const auto noise = std::sin(2.4 * step);
      now_s += solver->t_s()[stride];
      const auto w2 = solver->w_m2ps2()[stride];
      x = {0, std::max(0., w2 * (1 + 0.01 * noise)),
           solver->accel_mps2()[stride] + 0.01 * noise};
    }
  }
  file["instances"] = list;
  return file;
}

} // namespace

void write_practice(const std::filesystem::path& file, std::string_view kind) {
  constexpr std::array<std::string_view, 2> kinds{"path", "velocity"};
  if (std::ranges::find(kinds, kind) == kinds.end())
    throw input_error("--practice: "
                      + unknown_word("kind of problem", kind, kinds));
  const auto all = kind == kinds[0] ? path_drive() : velocity_drives();
  write_file(file, all.dump() + '\n');
}

} // namespace sofof::experiments
