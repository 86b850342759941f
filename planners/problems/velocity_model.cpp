// The velocity problem's model, in loops that become vector code.
#include "planners/problems/velocity_model.hpp"

#include "planners/ocp/checks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sofof::planners::ocp {

namespace {

// In one step of the iteration no speed may fall further, or the linear model
// of time means nothing: by this share, and always by a little.
constexpr double most_fall = 0.8;
constexpr double little_m2ps2 = 0.1;

// Under the root of a length, so that its gradient exists at 0; (m/s²)².
constexpr double rounding = 1e-12;

constexpr double crawl2 = crawl_mps * crawl_mps;

// speed_of, for vector code.
inline double speed(double w) {
  return std::sqrt(2 * (w > 0 ? w : 0) + crawl2);
}

} // namespace

void velocity_model::linearise(workspace& w) const noexcept {
  const auto m = w.padded;
  const double h = ds, bow = h * h / 2;
  assert(w.is_sized() && ds > 0);
  const auto& x = w.iterate;
  const auto& ref = reference;
  auto& a = w.model;
  auto& rows = w.rows;
  // Or the model were not convex.
  assert(all_at_least(
             std::span{ref.speed_weight}.first(static_cast<std::size_t>(m)), 0)
         && all_at_least(
             std::span{ref.jerk_weight}.first(static_cast<std::size_t>(m)), 0));
  a.a12 = h;
  a.b1 = bow;
  a.b2 = h;
#pragma omp simd
  for (int k = 0; k < m; ++k) {
    const double t = x.x0[k], at = x.x1[k], acc = x.x2[k], u = x.u[k];
    const double next = at + h * acc + bow * u;
    const double v = speed(at), v1 = speed(next);
    const double i = 1 / v, share = 1 / (v + v1);
    const double change = -2 * h * share * share;
    const double by_next = change / v1;
    a.a01[k] = change * i + by_next;
    a.a02[k] = by_next * h;
    a.b0[k] = by_next * bow;
    w.gap0[k] = t + 2 * h * share;
    w.gap1[k] = next;
    w.gap2[k] = acc + h * u;
    rows.time.c[k] = t;
    rows.speed.c[k] = at;
    rows.accel.c[k] = acc;
    const double bend = 2 * ref.curvature[k], across = bend * at;
    const double length = std::sqrt(acc * acc + across * across + rounding);
    rows.total.c[k] = length;
    rows.total.g1[k] = bend * across / length;
    rows.total.g2[k] = acc / length;
    rows.jerk.c[k] = u * v;
    rows.jerk.g1[k] = u * i;
    rows.jerk.gu[k] = v;
    const double q = ref.speed_weight[k], p = ref.jerk_weight[k];
    w.cost.h11[k] = q + p * (u * i) * (u * i);
    w.cost.s1[k] = p * u;
    w.cost.r[k] = p * (v * v);
    w.slope.x0[k] = 0;
    w.slope.x1[k] = q * (at - ref.wanted[k]) + p * (u * u);
    w.slope.x2[k] = w.cost.h22[k] * acc;
    w.slope.u[k] = p * (u * (v * v));
  }
}

double velocity_model::roll_out(workspace& w) const noexcept {
  const auto& aim = w.iterate;
  auto& plan = w.plan;
  const double most = w.rows.jerk.hi[0];
  assert(w.is_sized() && ds > 0 && most > 0);
  assert(model_error.time_s > 0 && model_error.jerk_mps3 > 0);
  double t = aim.x0[0], at = aim.x1[0], acc = aim.x2[0];
  const auto& modelled = w.rows.jerk.c;
  double v = speed(at), late = 0, jerky = 0, before = 0;
  for (int k = 0; k < w.n; ++k) {
    plan.x0[k] = t;
    plan.x1[k] = at;
    plan.x2[k] = acc;
    const double e0 = t - aim.x0[k], e1 = at - aim.x1[k];
    const double e2 = acc - aim.x2[k];
    late = std::max(late, std::abs(e0));
    // Lateness a step ago is as good, and no step waits for its own time.
    double u = aim.u[k] + (w.k0[k] * before + (w.k1[k] * e1 + w.k2[k] * e2));
    before = e0;
    if (std::abs(u) * v > most)
      u = std::copysign(most / v, u);
    plan.u[k] = u;
    jerky = std::max(jerky, std::abs(u * v - modelled[k]));
    at += ds * acc + ds * ds / 2 * u;
    acc += ds * u;
    const double next = speed(at);
    assert(!(next < crawl_mps)); // so that times rise
    t += 2 * ds / (v + next);
    v = next;
  }
  const auto n = w.n;
  plan.x0[n] = t;
  plan.x1[n] = at;
  plan.x2[n] = acc;
  late = std::max(late, std::abs(t - aim.x0[n]));
  return std::max(late / model_error.time_s, jerky / model_error.jerk_mps3);
}

double velocity_model::evaluate(workspace& w) const noexcept {
  const auto m = w.padded;
  const auto& x = w.plan;
  const auto& ref = reference;
  auto& rows = w.rows;
  assert(w.is_sized());
  double twice = 0;
#pragma omp simd reduction(+ : twice)
  for (int k = 0; k < m; ++k) {
    const double at = x.x1[k], acc = x.x2[k], jerk = x.u[k] * speed(at);
    const double off = at - ref.wanted[k];
    const double across = 2 * ref.curvature[k] * at;
    rows.time.c[k] = x.x0[k];
    rows.speed.c[k] = at;
    rows.accel.c[k] = acc;
    rows.total.c[k] = std::sqrt(acc * acc + across * across);
    rows.jerk.c[k] = jerk;
    twice += ref.speed_weight[k] * (off * off) + w.cost.h22[k] * (acc * acc)
             + ref.jerk_weight[k] * (jerk * jerk);
  }
  assert(!(twice < 0)); // no weight is
  return twice / 2;
}

double velocity_model::longest_step(const workspace& w) const noexcept {
  const auto& x = w.iterate.x1;
  const auto& e = w.direction.x1;
  assert(w.is_sized());
  double most = 1; // of the fall over what may fall
#pragma omp simd reduction(max : most)
  for (int k = 0; k < w.padded; ++k) {
    const double may = most_fall * (x[k] > 0 ? x[k] : 0) + little_m2ps2;
    const double fall = -e[k] / may;
    most = fall > most ? fall : most;
  }
  assert(most >= 1);
  return 1 / most;
}

} // namespace sofof::planners::ocp
