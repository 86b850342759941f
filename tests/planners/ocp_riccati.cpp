// The structured Riccati sweep against a plain one in matrices.
#include "planners/ocp/riccati.hpp"
#include "planners/problems/path_model.hpp"
#include "planners/problems/velocity_model.hpp"
#include "tests/support/dice.hpp"

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include <memory>
#include <vector>

namespace sofof::planners::ocp {
namespace {

constexpr auto steps = 60;
constexpr auto tolerance = 1e-12;

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct direction {
  std::vector<Vector3d> x;
  std::vector<double> u;
};

/// The textbook: P, p backwards, then x, u forwards.
template <class Workspace>
direction reference(const Workspace& w, bool gaps) {
  const auto& m = w.model;
  const auto& h = w.h;
  const auto state_hessian = [&h](int k) {
    Matrix3d q;
    q << value(h.h00[k]), value(h.h01[k]), value(h.h02[k]), value(h.h01[k]),
        value(h.h11[k]), value(h.h12[k]), value(h.h02[k]), value(h.h12[k]),
        value(h.h22[k]);
    return q;
  };
  const auto a = [&m](int k) {
    Matrix3d x;
    x << value(m.a00[k]), value(m.a01[k]), value(m.a02[k]), value(m.a10[k]),
        value(m.a11[k]), value(m.a12[k]), value(m.a20[k]), value(m.a21[k]),
        value(m.a22[k]);
    return x;
  };
  const auto b = [&m](int k) {
    return Vector3d{value(m.b0[k]), value(m.b1[k]), value(m.b2[k])};
  };
  const auto gap = [&](int k) -> Vector3d {
    return gaps ? Vector3d{w.gap0[k], w.gap1[k], w.gap2[k]} : Vector3d::Zero();
  };
  const auto slope = [&](int k) {
    return Vector3d{w.g.x0[k], w.g.x1[k], w.g.x2[k]};
  };
  std::vector<Vector3d> gain(steps);
  std::vector<double> feed(steps);
  Matrix3d p = state_hessian(steps);
  Vector3d q = slope(steps);
  for (int k = steps - 1; k >= 0; --k) {
    const Vector3d s{value(h.s0[k]), value(h.s1[k]), value(h.s2[k])};
    q += p * gap(k);
    const auto quu = h.r[k] + b(k).dot(p * b(k));
    const Vector3d qux = s + a(k).transpose() * p * b(k);
    const auto qu = w.g.u[k] + b(k).dot(q);
    gain[k] = -qux / quu;
    feed[k] = -qu / quu;
    q = (slope(k) + a(k).transpose() * q + qux * feed[k]).eval();
    p = (state_hessian(k) + a(k).transpose() * p * a(k)
         + qux * gain[k].transpose())
            .eval();
  }
  direction d{{Vector3d::Zero()}, {}};
  for (int k = 0; k < steps; ++k) {
    d.u.push_back(feed[k] + gain[k].dot(d.x[k]));
    d.x.push_back(a(k) * d.x[k] + b(k) * d.u[k] + gap(k));
  }
  return d;
}

template <class Workspace>
double distance(const Workspace& w, const direction& d) {
  auto worst = 0., largest = 0.;
  for (int k = 0; k <= steps; ++k) {
    const Vector3d x{w.direction.x0[k], w.direction.x1[k], w.direction.x2[k]};
    worst = std::max(worst, (x - d.x[k]).norm());
    largest = std::max(largest, d.x[k].norm());
  }
  return worst / largest;
}

// What a pattern leaves open gets random numbers.
struct filler {
  test::dice dice{7};

  void operator()(series<entry::varying>& s, double low, double high) {
    for (int k = 0; k <= steps; ++k)
      s[k] = dice.between(low, high);
  }
  void operator()(series<entry::constant>& s, double low, double high) {
    s = dice.between(low, high);
  }
  template <entry kind>
  void operator()(series<kind>&, double, double) {}

  template <class Workspace>
  void fill(Workspace& w) {
    auto& m = w.model;
    auto& h = w.h;
    (*this)(m.a00, 0.9, 1.1);
    (*this)(m.a01, -0.5, 0.5);
    (*this)(m.a02, -0.5, 0.5);
    (*this)(m.a10, -0.1, 0.1);
    (*this)(m.a11, 0.9, 1.1);
    (*this)(m.a12, -0.5, 0.5);
    (*this)(m.b0, -0.5, 0.5);
    (*this)(m.b1, -0.5, 0.5);
    (*this)(m.b2, 0.5, 1);
    // Diagonally dominant.
    (*this)(h.h00, 4, 5);
    (*this)(h.h11, 4, 5);
    (*this)(h.h22, 4, 5);
    (*this)(h.r, 4, 5);
    (*this)(h.h01, -1, 1);
    (*this)(h.h02, -1, 1);
    (*this)(h.h12, -1, 1);
    (*this)(h.s0, -1, 1);
    (*this)(h.s1, -1, 1);
    (*this)(h.s2, -1, 1);
    gradients(w);
    for (int k = 0; k < steps; ++k) {
      w.gap0[k] = dice.between(-1, 1);
      w.gap1[k] = dice.between(-1, 1);
      w.gap2[k] = dice.between(-1, 1);
    }
  }

  template <class Workspace>
  void gradients(Workspace& w) {
    for (auto* g : {&w.g.x0, &w.g.x1, &w.g.x2, &w.g.u})
      for (int k = 0; k <= steps; ++k)
        (*g)[k] = dice.between(-10, 10);
  }
};

template <class Model>
void compare() {
  const auto w = std::make_unique<workspace<Model>>();
  w->n = steps;
  w->padded = padded(steps + 1);
  filler filler;
  filler.fill(*w);
  CHECK(factorise<true>(*w) > 0);
  sweep_forward<true>(*w);
  CHECK(distance(*w, reference(*w, true)) < tolerance);
  CHECK(factorise<false>(*w) > 0);
  sweep_forward<false>(*w);
  CHECK(distance(*w, reference(*w, false)) < tolerance);
  filler.gradients(*w);
  const auto decrement = resolve(*w);
  sweep_forward<false>(*w);
  CHECK(distance(*w, reference(*w, false)) < tolerance);
  CHECK(decrement == doctest::Approx(factorise<false>(*w)).epsilon(1e-12));
}

} // namespace

TEST_CASE("the path's Riccati sweep is the one of the textbook") {
  compare<path_model>();
}

TEST_CASE("the velocity's Riccati sweep is the one of the textbook") {
  compare<velocity_model>();
}

TEST_CASE("a problem that is not convex in the control is found out") {
  const auto w = std::make_unique<workspace<path_model>>();
  w->n = steps;
  filler{}.fill(*w);
  w->h.r[steps / 2] = -1e3;
  CHECK(factorise<false>(*w) < 0);
}

} // namespace sofof::planners::ocp
