// Checks a path problem, sets it up, and has it solved.
#include "planners/problems/path_ocp.hpp"

#include "planners/ocp/checks.hpp"
#include "planners/ocp/ms_al.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

using ocp::path_model;

bool sensible(const path_problem& p) {
  if (p.steps < 1 || p.steps > ocp::most_steps)
    return false;
  const auto n = static_cast<std::size_t>(p.steps);
  const auto& w = p.weights;
  const std::array numbers{p.ds_m, p.start.d_m, p.start.heading_rad,
                           p.start.curvature_1pm};
  const std::array limits{w.offset,       w.heading,    w.curvature,
                          w.rate,         w.end_factor, p.curvature_max_1pm,
                          p.rate_max_1pm2};
  if (!ocp::all_finite(numbers) || !ocp::all_finite(limits)
      || !ocp::all_at_least(limits, 0) || p.ds_m <= 0 || w.rate == 0)
    return false;
  if (p.curvature_1pm.size() != 2 * n + 1 || p.wanted_m.size() != n + 1
      || !ocp::all_finite(p.curvature_1pm) || !ocp::all_finite(p.wanted_m))
    return false;
  if (p.discs.empty() || p.discs.size() > ocp::path_rows::most_discs)
    return false;
  for (const auto& disc : p.discs)
    if (!std::isfinite(disc.ahead_m) || disc.lo_m.size() != n + 1
        || disc.hi_m.size() != n + 1 || !ocp::no_nan(disc.lo_m)
        || !ocp::no_nan(disc.hi_m))
      return false;
  const auto tighter = p.rate_max_at_1pm2;
  if (!tighter.empty()
      && (tighter.size() != n || !ocp::all_at_least(tighter, 0)))
    return false;
  const auto q = [&p](double d, std::size_t k) {
    return 1 - d * p.curvature_1pm[2 * k];
  };
  if (std::abs(p.start.heading_rad) > path_model::most_heading_rad
      || q(p.start.d_m, 0) <= path_model::least_q)
    return false;
  for (std::size_t k = 0; k <= n; ++k)
    if (q(p.wanted_m[k], k) <= path_model::least_q)
      return false;
  return true;
}

} // namespace

void path_ocp::set_up(const path_problem& p, const path_options& options,
                      ocp::start from) noexcept {
  auto& w = w_;
  auto& rows = w.rows;
  auto& ref = reference_;
  const auto n = w.n = p.steps;
  const auto m = w.padded = ocp::padded(n + 1);
  assert(w.is_sized());
  assert(p.curvature_1pm.size() == 2 * static_cast<std::size_t>(n) + 1);
  const auto* curvature = p.curvature_1pm.data();
  for (int k = 0; k < n; ++k) {
    ref.curvature[k] = curvature[2 * k];
    ref.halfway[k] = curvature[2 * k + 1];
  }
  std::copy_n(p.wanted_m.data(), n + 1, ref.wanted.data());
  ref.curvature[n] = curvature[2 * n];
  ref.halfway[n] = 0;
  for (int k = n + 1; k < m; ++k)
    ref.curvature[k] = ref.halfway[k] = ref.wanted[k] = 0;

  for (int k = 0; k < m; ++k) {
    const double stage = k < n ? 2 * p.ds_m : 0;
    const double state = k == n ? 2 * p.weights.end_factor : stage;
    w.cost.h00[k] = state * p.weights.offset;
    w.cost.h11[k] = state * p.weights.heading;
    w.cost.h22[k] = state * p.weights.curvature;
    w.cost.r[k] = stage * p.weights.rate;
  }

  const auto& rho = from == ocp::start::warm ? options.warm : options.cold;
  const auto& tolerance = options.tolerances;
  assert(rho.corridor > 0 && rho.curvature > 0 && rho.rate > 0);
  assert(tolerance.corridor > 0 && tolerance.curvature > 0
         && tolerance.rate > 0);
  rows.discs = static_cast<int>(p.discs.size());
  for (std::size_t j = 0; j < p.discs.size(); ++j) {
    auto& row = rows.disc[j];
    row.open(m, rho.corridor, tolerance.corridor);
    std::copy_n(p.discs[j].lo_m.data() + 1, n, row.lo.data() + 1);
    std::copy_n(p.discs[j].hi_m.data() + 1, n, row.hi.data() + 1);
  }
  rows.curvature.open(m, rho.curvature, tolerance.curvature);
  rows.rate.open(m, rho.rate, tolerance.rate);
  for (int k = 1; k <= n; ++k) {
    rows.curvature.lo[k] = -p.curvature_max_1pm;
    rows.curvature.hi[k] = p.curvature_max_1pm;
  }
  for (int k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double most = p.rate_max_at_1pm2.empty()
                            ? p.rate_max_1pm2
                            : std::min(p.rate_max_1pm2, p.rate_max_at_1pm2[at]);
    rows.rate.lo[k] = -most;
    rows.rate.hi[k] = most;
  }
}

// As the reference bends. Its knots do not join: rolled out, the plan would
// leave the reference, and turn away from it.
void path_ocp::guess(const path_problem& p) noexcept {
  const auto most = p.curvature_max_1pm;
  assert(most >= 0 && w_.n == p.steps);
  auto& x = w_.plan;
  for (int k = 0; k <= p.steps; ++k) {
    x.x0[k] = x.x1[k] = x.u[k] = 0;
    x.x2[k] = std::clamp(reference_.curvature[k], -most, most);
  }
  w_.rows.each([](auto& row, int) { row.y.fill(0); });
}

void path_ocp::carry_over(double by_m, double ds_m, int steps) noexcept {
  started_ = started_ && ocp::can_move(by_m, ds_m, steps);
  if (!started_)
    return;
  assert(w_.n >= 1 && ds_m_ > 0);
  const auto knots = ocp::regrid::after(by_m, ds_m_, w_.n, ds_m, steps);
  auto& x = w_.plan;
  for (auto* column : {&x.x0, &x.x1, &x.x2})
    ocp::resample(*column, knots, 1, (*column)[w_.n]);
  ocp::resample(x.u, knots.of_steps(), 1, 0);
  ocp::resample_multipliers(w_.rows, knots, rate_row);
  w_.n = steps;
  w_.padded = ocp::padded(steps + 1);
  ds_m_ = ds_m;
}

void path_ocp::keep(ocp::kept_plan& out) const {
  if (started_)
    ocp::keep(w_, ds_m_, out);
  else
    out.steps = 0;
  assert(out.is_empty() || out.steps == w_.n);
}

void path_ocp::resume(const ocp::kept_plan& from) {
  ocp::poison(w_);
  started_ = !from.is_empty();
  if (!started_)
    return;
  ds_m_ = from.ds_m;
  w_.rows.discs = ocp::path_rows::most_discs; // all that may be
  ocp::restore(from, w_);
  assert(w_.is_sized());
}

ocp::solve_report path_ocp::solve(const path_problem& problem, ocp::start from,
                                  const path_options& options,
                                  const ocp::budget& go_on) noexcept {
  if (!sensible(problem))
    return {};
  started_ =
      started_ && ocp::same_grid(ds_m_, w_.n, problem.ds_m, problem.steps);
  ds_m_ = problem.ds_m;
  if (!started_)
    from = ocp::start::cold;
  set_up(problem, options, from);
  if (const auto worst = ocp::crossed_bounds(w_); worst.knot >= 0)
    return ocp::refusal(worst);
  if (from == ocp::start::cold)
    guess(problem);
  w_.plan.x0[0] = problem.start.d_m;
  w_.plan.x1[0] = problem.start.heading_rad;
  w_.plan.x2[0] = problem.start.curvature_1pm;
  path_model model{.ds = problem.ds_m,
                   .reference = reference_,
                   .model_error = options.model_error};
  for (std::size_t j = 0; j < problem.discs.size(); ++j)
    model.ahead[j] = problem.discs[j].ahead_m;
  assert(options.model_error > 0);
  const auto report = ocp::ms_al{model, w_, options.solver}.solve(go_on);
  assert(!ocp::publishable(report.status) || std::isfinite(report.cost));
  assert(!ocp::publishable(report.status)
         || (offset_m()[0] == problem.start.d_m
             && heading_rad()[0] == problem.start.heading_rad
             && curvature_1pm()[0] == problem.start.curvature_1pm));
  assert(!ocp::publishable(report.status)
         || (ocp::all_finite(offset_m()) && ocp::all_finite(rate_1pm2())));
  started_ = report.status != ocp::solve_status::numerical;
  return report;
}

} // namespace sofof::planners
