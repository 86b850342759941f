// Checks a velocity problem, sets it up, and has it solved.
#include "planners/problems/velocity_ocp.hpp"

#include "planners/ocp/checks.hpp"
#include "planners/ocp/ms_al.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners {

namespace {

// Way over which a difference to the last plan fades.
constexpr double fading_m = 3;

bool sensible(const velocity_problem& p) {
  if (p.steps < 1 || p.steps > ocp::most_steps)
    return false;
  const auto knots = static_cast<std::size_t>(p.steps) + 1;
  const auto& l = p.limits;
  const auto& q = p.weights;
  const std::array numbers{p.ds_m, p.start.t_s, p.start.accel_mps2};
  const std::array positive{
      p.start.w_m2ps2,  -l.accel_min_mps2, l.accel_max_mps2, l.jerk_max_mps3,
      l.total_max_mps2, q.speed,           q.accel,          q.jerk,
      q.end_m};
  if (!ocp::all_finite(numbers) || !ocp::all_finite(positive)
      || !ocp::all_at_least(positive, 0) || p.ds_m <= 0 || q.jerk == 0
      || l.jerk_max_mps3 == 0)
    return false;
  const auto finite = {p.w_max_m2ps2, p.wanted_m2ps2, p.curvature_1pm};
  for (const auto values : finite)
    if (values.size() != knots || !ocp::all_finite(values))
      return false;
  for (const auto times : {p.earliest_s, p.latest_s})
    if (times.size() != knots || !ocp::no_nan(times))
      return false;
  if (!ocp::all_at_least(p.wanted_m2ps2, std::numeric_limits<double>::min()))
    return false;
  return !p.stop_knot || *p.stop_knot >= 1;
}

} // namespace

void velocity_ocp::set_up(const velocity_problem& p) noexcept {
  auto& ref = reference_;
  const auto n = w_.n = p.steps;
  const auto m = w_.padded = ocp::padded(n + 1);
  assert(w_.is_sized());
  std::copy_n(p.wanted_m2ps2.data(), n + 1, ref.wanted.data());
  std::copy_n(p.curvature_1pm.data(), n + 1, ref.curvature.data());
  for (int k = 0; k <= n; ++k) {
    const double length = k < n ? p.ds_m : p.weights.end_m;
    assert(ref.wanted[k] > 0 && length >= 0);
    ref.speed_weight[k] = length * p.weights.speed / ref.wanted[k];
    ref.jerk_weight[k] = k < n ? 2 * p.ds_m * p.weights.jerk : 0;
    w_.cost.h22[k] = 2 * length * p.weights.accel;
  }
  for (int k = n + 1; k < m; ++k) {
    ref.wanted[k] = ref.curvature[k] = 0;
    ref.speed_weight[k] = ref.jerk_weight[k] = w_.cost.h22[k] = 0;
  }
}

void velocity_ocp::set_bounds(const velocity_problem& p,
                              const velocity_options& options,
                              ocp::start from) noexcept {
  auto& rows = w_.rows;
  const auto n = w_.n, m = w_.padded;
  const auto& l = p.limits;
  const auto& rho = from == ocp::start::warm ? options.warm : options.cold;
  const auto& tolerance = options.tolerances;
  assert(w_.is_sized() && n == p.steps);
  assert(rho.time > 0 && rho.speed > 0 && rho.accel > 0 && rho.total > 0
         && rho.jerk > 0);
  assert(tolerance.time > 0 && tolerance.speed > 0 && tolerance.accel > 0
         && tolerance.total > 0 && tolerance.jerk > 0);
  rows.time.open(m, rho.time, tolerance.time);
  rows.speed.open(m, rho.speed, tolerance.speed);
  rows.accel.open(m, rho.accel, tolerance.accel);
  rows.total.open(m, rho.total, tolerance.total);
  rows.jerk.open(m, rho.jerk, tolerance.jerk);
  std::copy_n(p.earliest_s.data() + 1, n, rows.time.lo.data() + 1);
  std::copy_n(p.latest_s.data() + 1, n, rows.time.hi.data() + 1);
  std::copy_n(p.w_max_m2ps2.data() + 1, n, rows.speed.hi.data() + 1);
  rows.timed = ocp::any_finite(p.earliest_s) || ocp::any_finite(p.latest_s);
  if (!rows.timed)
    rows.time.y.fill(0);
  const auto stop = p.stop_knot.value_or(n + 1);
  assert(stop >= 1); // at knot 0 the car is as it is
  for (int k = 1; k <= n; ++k) {
    const auto rests = k >= stop;
    rows.speed.lo[k] = 0;
    rows.accel.lo[k] = rests ? 0 : l.accel_min_mps2;
    rows.accel.hi[k] = rests ? 0 : l.accel_max_mps2;
    if (rests)
      rows.speed.hi[k] = std::min(0., rows.speed.hi[k]);
  }
  for (int k = std::max(1, l.total_from); k <= n; ++k)
    rows.total.hi[k] = l.total_max_mps2;
  for (int k = 0; k < n; ++k) {
    rows.jerk.lo[k] = -l.jerk_max_mps3;
    rows.jerk.hi[k] = l.jerk_max_mps3;
  }
}

// Bounds on any plan: none is slower than full braking, none faster than full
// acceleration that still can brake for what comes. Waiting for a window to
// open, or having to be through before it closes, moves these times.
ocp::violation
velocity_ocp::hopeless(const velocity_problem& p) const noexcept {
  const auto& l = p.limits;
  const auto& time = w_.rows.time;
  const auto& speed = w_.rows.speed;
  const auto h = p.ds_m;
  const auto n = p.steps;
  assert(h > 0 && l.jerk_max_mps3 > 0);
  assert(l.accel_min_mps2 <= 0 && l.accel_max_mps2 >= 0);
  const auto early = ocp::any_finite(p.earliest_s);
  const auto late = ocp::any_finite(p.latest_s);
  ocp::column most;
  ocp::violation worst;
  double lower = p.start.accel_mps2, upper = lower, change = 0;
  double least = p.start.w_m2ps2, v = ocp::speed_of(least);
  double slowest = p.start.t_s;
  most[0] = least;
  for (int k = 0; k < n; ++k) {
    // The slower, the faster may acceleration change.
    if (lower > l.accel_min_mps2 || upper < l.accel_max_mps2)
      change = h * l.jerk_max_mps3 / v;
    const double down = std::max(lower - change, l.accel_min_mps2);
    const double up = std::min(upper + change, l.accel_max_mps2);
    least = std::max(0., least + h * (lower + down) / 2);
    most[k + 1] = std::min(speed.hi[k + 1], most[k] + h * (upper + up) / 2);
    lower = down, upper = up;
    assert(least >= 0 && v >= ocp::crawl_mps);
    worst.keep_worse(least - speed.hi[k + 1], speed.tolerance, speed_row,
                     k + 1);
    const double next = ocp::speed_of(least);
    if (early) {
      slowest = std::min(slowest + 2 * h / (v + next), time.hi[k + 1]);
      worst.keep_worse(time.lo[k + 1] - slowest, time.tolerance, time_row,
                       k + 1);
    }
    v = next;
    if (least == 0 && !w_.rows.timed)
      return worst;
  }
  if (!late)
    return worst;
  for (int k = n - 1; k > 0; --k)
    most[k] = std::min(most[k], most[k + 1] - h * l.accel_min_mps2);
  double fastest = p.start.t_s;
  v = ocp::speed_of(most[0]);
  for (int k = 0; k < n; ++k) {
    const double next = ocp::speed_of(most[k + 1]);
    fastest = std::max(fastest + 2 * h / (v + next), time.lo[k + 1]);
    v = next;
    worst.keep_worse(fastest - time.hi[k + 1], time.tolerance, time_row, k + 1);
  }
  return worst;
}

// A gentle ramp up to the limit. Its knots do not join, and so the first step
// goes all the way to something that can be driven.
void velocity_ocp::guess(const velocity_problem& p) noexcept {
  constexpr auto ramp_mps2 = 1.;
  const auto h = p.ds_m;
  assert(h > 0 && w_.n == p.steps);
  auto& x = w_.plan;
  x.x0[0] = p.start.t_s;
  x.x1[0] = p.start.w_m2ps2;
  x.x2[0] = p.start.accel_mps2;
  double v = ocp::speed_of(x.x1[0]);
  for (int k = 0; k < p.steps; ++k) {
    x.x1[k + 1] = std::min(x.x1[k] + h * ramp_mps2, w_.rows.speed.hi[k + 1]);
    x.x2[k + 1] = (x.x1[k + 1] - x.x1[k]) / h;
    x.u[k] = 0;
    const double next = ocp::speed_of(x.x1[k + 1]);
    assert(next >= ocp::crawl_mps); // so that times rise
    x.x0[k + 1] = x.x0[k] + 2 * h / (v + next);
    v = next;
  }
  w_.rows.each([](auto& row, int) { row.y.fill(0); });
}

// Drives after the last plan from where the vehicle is: what is different
// fades. So knots join, and the first step stops at bounds that the old
// multipliers do not know.
void velocity_ocp::follow(const velocity_problem& p) noexcept {
  constexpr auto pull = 1 / fading_m;
  const auto h = p.ds_m, bow = h * h / 2;
  assert(started_ && w_.n == p.steps);
  // u = own − 2 pull a − pull² w, put into the dynamics: short chains.
  const auto ww = 1 - bow * pull * pull, wa = h - 2 * bow * pull;
  const auto aw = -h * pull * pull, aa = 1 - 2 * h * pull;
  auto& x = w_.plan;
  double t = p.start.t_s, w = p.start.w_m2ps2, a = p.start.accel_mps2;
  double v = ocp::speed_of(w);
  for (int k = 0; k < p.steps; ++k) {
    const double own = x.u[k] + pull * (2 * x.x2[k] + pull * x.x1[k]);
    x.x0[k] = t;
    x.x1[k] = w;
    x.x2[k] = a;
    x.u[k] = own - pull * (2 * a + pull * w);
    const double next = ww * w + (wa * a + bow * own);
    a = aw * w + (aa * a + h * own);
    w = next;
    const double faster = ocp::speed_of(w);
    assert(!(faster < ocp::crawl_mps));
    t += 2 * h / (v + faster);
    v = faster;
  }
  x.x0[p.steps] = t;
  x.x1[p.steps] = w;
  x.x2[p.steps] = a;
}

// Whether the last plan comes to rest where it now should not, or the reverse.
// It would mislead: at rest, time hardly has a slope.
bool velocity_ocp::rests_elsewhere(const velocity_problem& p) const noexcept {
  constexpr auto rest_m2ps2 = 1e-2, far_m = 1.;
  const auto end = p.steps + 1;
  int rest = end;
  while (rest > 0 && w_.plan.x1[rest - 1] < rest_m2ps2)
    --rest;
  const auto stop = std::min(p.stop_knot.value_or(end), end);
  assert(stop >= 1 && rest >= 0);
  return (rest < end) != (stop < end) || std::abs(rest - stop) * p.ds_m > far_m;
}

// By how much the plan is too early or too late, at worst.
double velocity_ocp::misses_s() const noexcept {
  const auto& row = w_.rows.time;
  assert(w_.is_sized());
  double most = 0;
#pragma omp simd reduction(max : most)
  for (int k = 0; k <= w_.n; ++k) {
    const double miss =
        std::abs(ocp::beyond(w_.plan.x0[k], row.lo[k], row.hi[k]));
    most = miss > most ? miss : most;
  }
  return most;
}

void velocity_ocp::carry_over(double by_m, double ds_m, int steps) noexcept {
  started_ = started_ && ocp::can_move(by_m, ds_m, steps);
  if (!started_)
    return;
  assert(w_.n >= 1 && ds_m_ > 0);
  const auto knots = ocp::regrid::after(by_m, ds_m_, w_.n, ds_m, steps);
  auto& x = w_.plan; // times are found anew, see follow
  ocp::resample(x.x1, knots, 1, x.x1[w_.n]);
  ocp::resample(x.x2, knots, 1, 0);
  ocp::resample(x.u, knots.of_steps(), 1, 0);
  ocp::resample_multipliers(w_.rows, knots, jerk_row);
  w_.n = steps;
  w_.padded = ocp::padded(steps + 1);
  ds_m_ = ds_m;
}

void velocity_ocp::keep(ocp::kept_plan& out) const {
  if (started_)
    ocp::keep(w_, ds_m_, out);
  else
    out.steps = 0;
  assert(out.is_empty() || out.steps == w_.n);
}

void velocity_ocp::resume(const ocp::kept_plan& from) {
  ocp::poison(w_);
  started_ = !from.is_empty();
  if (!started_)
    return;
  ds_m_ = from.ds_m;
  w_.rows.timed = true;
  ocp::restore(from, w_);
  assert(w_.is_sized());
}

ocp::solve_report velocity_ocp::solve(const velocity_problem& problem,
                                      ocp::start from,
                                      const velocity_options& options,
                                      const ocp::budget& go_on) noexcept {
  if (!sensible(problem))
    return {};
  started_ =
      started_ && ocp::same_grid(ds_m_, w_.n, problem.ds_m, problem.steps);
  ds_m_ = problem.ds_m;
  if (!started_)
    from = ocp::start::cold;
  set_up(problem);
  set_bounds(problem, options, from);
  auto worst = ocp::crossed_bounds(w_);
  if (worst.knot < 0)
    worst = hopeless(problem);
  if (worst.knot >= 0)
    return ocp::refusal(worst);
  if (from == ocp::start::warm) {
    const auto elsewhere = rests_elsewhere(problem);
    follow(problem);
    if (elsewhere || misses_s() > options.surprise_s) {
      from = ocp::start::cold;
      set_bounds(problem, options, from);
    }
  }
  if (from == ocp::start::cold)
    guess(problem);
  const ocp::velocity_model model{.ds = problem.ds_m,
                                  .reference = reference_,
                                  .model_error = options.model_error};
  assert(options.model_error.time_s > 0 && options.model_error.jerk_mps3 > 0);
  const auto report = ocp::ms_al{model, w_, options.solver}.solve(go_on);
  assert(!ocp::publishable(report.status) || std::isfinite(report.cost));
  assert(!ocp::publishable(report.status)
         || (t_s()[0] == problem.start.t_s
             && w_m2ps2()[0] == problem.start.w_m2ps2
             && accel_mps2()[0] == problem.start.accel_mps2));
  assert(!ocp::publishable(report.status)
         || (ocp::all_finite(u_1ps2()) && std::ranges::is_sorted(t_s())));
  started_ = report.status != ocp::solve_status::numerical;
  return report;
}

} // namespace sofof::planners
