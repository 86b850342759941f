// The models' derivatives, against the complex step (Squire & Trapp, SIAM
// Review 40(1), 1998): exact to rounding.
#include "planners/problems/path_model.hpp"
#include "planners/problems/velocity_model.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <array>
#include <complex>
#include <memory>

namespace sofof::planners::ocp {
namespace {

using complex = std::complex<double>;

constexpr auto tiny = 1e-30;
constexpr auto model_steps = 80;

/// Column `i` of [A B] of a step f(x, u).
template <class Step>
std::array<double, 3> derivative(Step f, const std::array<double, 4>& at,
                                 int i) {
  std::array<complex, 4> z{at[0], at[1], at[2], at[3]};
  z[static_cast<std::size_t>(i)] += complex{0, tiny};
  const auto y = f(std::array<complex, 3>{z[0], z[1], z[2]}, z[3]);
  return {y[0].imag() / tiny, y[1].imag() / tiny, y[2].imag() / tiny};
}

/// The model's [A B] at a knot, by columns.
template <class Model>
std::array<std::array<double, 3>, 4> columns(const Model& m, int k) {
  return {{{value(m.a00[k]), value(m.a10[k]), value(m.a20[k])},
           {value(m.a01[k]), value(m.a11[k]), value(m.a21[k])},
           {value(m.a02[k]), value(m.a12[k]), value(m.a22[k])},
           {value(m.b0[k]), value(m.b1[k]), value(m.b2[k])}}};
}

template <class Step, class Workspace>
void check_step(Step step, const Workspace& w, int k) {
  const auto& x = w.iterate;
  const std::array at{x.x0[k], x.x1[k], x.x2[k], x.u[k]};
  const auto model = columns(w.model, k);
  for (int i = 0; i < 4; ++i) {
    const auto exact = derivative(step, at, i);
    for (std::size_t j = 0; j < 3; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      CHECK(model[static_cast<std::size_t>(i)][j]
            == doctest::Approx(exact[j]).epsilon(1e-12));
    }
  }
  const auto next =
      step(std::array<complex, 3>{at[0], at[1], at[2]}, complex{at[3]});
  CHECK(w.gap0[k] == doctest::Approx(next[0].real()).epsilon(1e-13));
  CHECK(w.gap1[k] == doctest::Approx(next[1].real()).epsilon(1e-13));
  CHECK(w.gap2[k] == doctest::Approx(next[2].real()).epsilon(1e-13));
}

/// A row's gradient against that of its formula.
template <class Row, class Formula>
void check_row(const Row& row, Formula f, const stages& x, int k) {
  const std::array at{x.x0[k], x.x1[k], x.x2[k], x.u[k]};
  const std::array gradient{value(row.g0[k]), value(row.g1[k]),
                            value(row.g2[k]), value(row.gu[k])};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<complex, 4> z{at[0], at[1], at[2], at[3]};
    z[i] += complex{0, tiny};
    const auto c = f(z);
    CAPTURE(i);
    CHECK(row.c[k] == doctest::Approx(c.real()).epsilon(1e-9));
    CHECK(gradient[i] == doctest::Approx(c.imag() / tiny).epsilon(1e-9));
  }
}

} // namespace

TEST_CASE("the path's linear model is the derivative of its step") {
  const auto w = std::make_unique<path_model::workspace>();
  const auto reference = std::make_unique<path_reference>();
  test::dice dice{1};
  w->n = model_steps;
  w->padded = padded(model_steps + 1);
  w->rows.discs = 4;
  for (int k = 0; k <= model_steps; ++k) {
    w->iterate.x0[k] = dice.between(-3, 3);
    w->iterate.x1[k] = dice.between(-0.9, 0.9);
    w->iterate.x2[k] = dice.between(-0.2, 0.2);
    w->iterate.u[k] = dice.between(-0.1, 0.1);
    reference->curvature[k] = dice.between(-0.2, 0.2);
    reference->halfway[k] = dice.between(-0.2, 0.2);
  }
  const path_model model{
      .ds = 0.7, .reference = *reference, .ahead = {-0.4, 0, 2, 3.4}};
  model.linearise(*w);
  for (int k = 0; k < model_steps; ++k) {
    const auto step = [&](const std::array<complex, 3>& x, complex u) {
      return path_step(x, u, reference->curvature[k], reference->halfway[k],
                       model.ds);
    };
    check_step(step, *w, k);
    for (std::size_t j = 0; j < 4; ++j)
      check_row(
          w->rows.disc[j],
          [&](auto& z) { return z[0] + model.ahead[j] * std::sin(z[1]); },
          w->iterate, k);
  }
}

TEST_CASE("the velocity's linear model is the derivative of its step") {
  const auto w = std::make_unique<velocity_model::workspace>();
  const auto reference = std::make_unique<velocity_reference>();
  test::dice dice{2};
  w->n = model_steps;
  w->padded = padded(model_steps + 1);
  for (int k = 0; k <= model_steps; ++k) {
    w->iterate.x0[k] = dice.between(0, 30);
    w->iterate.x1[k] = dice.between(1.5, 100);
    w->iterate.x2[k] = dice.between(-2, 2);
    w->iterate.u[k] = dice.between(-0.5, 0.5);
    reference->curvature[k] = dice.between(-0.1, 0.1);
  }
  const velocity_model model{.ds = 0.5, .reference = *reference};
  model.linearise(*w);
  for (int k = 0; k < model_steps; ++k) {
    const auto step = [&](const std::array<complex, 3>& x, complex u) {
      return velocity_step(x, u, model.ds);
    };
    check_step(step, *w, k);
    const auto bend = reference->curvature[k];
    check_row(
        w->rows.total,
        [=](auto& z) {
          return std::sqrt(z[2] * z[2] + 4 * bend * bend * z[1] * z[1]);
        },
        w->iterate, k);
    check_row(
        w->rows.jerk, [](auto& z) { return z[3] * speed_of(z[1]); }, w->iterate,
        k);
  }
}

TEST_CASE("the vector sine and cosine are as good as the library's") {
  for (auto x = -1.2; x <= 1.2; x += 1e-3) {
    const auto [sine, cosine] = sin_cos(x);
    CHECK(std::abs(sine - std::sin(x)) < 1e-13);
    CHECK(std::abs(cosine - std::cos(x)) < 1e-13);
  }
}

} // namespace sofof::planners::ocp
