// A cubic spline through points of the plane, over chord length.
#include "base/spline.hpp"

#include <stdexcept>

namespace sofof {

namespace {

void check(std::span<const point> points, bool closed) {
  const std::size_t least = closed ? 3 : 2;
  if (points.size() < least)
    throw std::invalid_argument{closed
                                    ? "A closed path needs at least 3 points."
                                    : "An open path needs at least 2 points."};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto next = (i + 1) % points.size();
    if ((next != 0 || closed) && points[i] == points[next])
      throw std::invalid_argument{"Two neighbouring points of a path "
                                  "coincide."};
  }
}

/// A symmetric tridiagonal system, diagonally dominant; `side[i]` couples
/// rows i and i + 1.
struct tridiagonal {
  std::vector<double> diagonal;
  std::vector<double> side;

  /// Thomas algorithm, for right-hand sides of any vector type.
  template <class T>
  std::vector<T> solve(std::vector<T> rhs) const {
    const auto n = diagonal.size();
    std::vector<double> ratio(n);
    auto pivot = diagonal[0];
    rhs[0] = (1 / pivot) * rhs[0];
    for (std::size_t i = 1; i < n; ++i) {
      ratio[i] = side[i - 1] / pivot;
      pivot = diagonal[i] - side[i - 1] * ratio[i];
      rhs[i] = (1 / pivot) * (rhs[i] - side[i - 1] * rhs[i - 1]);
    }
    for (auto i = n - 1; i > 0; --i)
      rhs[i - 1] = rhs[i - 1] - ratio[i] * rhs[i];
    return rhs;
  }
};

/// Second derivatives at the points of an open spline, 0 at both ends.
std::vector<point> open_bends(std::span<const double> chords,
                              std::span<const point> slopes) {
  const auto n = chords.size();
  std::vector<point> bends(n + 1);
  if (n < 2)
    return bends;
  tridiagonal system;
  std::vector<point> rhs;
  for (std::size_t i = 1; i < n; ++i) {
    system.diagonal.push_back(2 * (chords[i - 1] + chords[i]));
    system.side.push_back(chords[i]);
    rhs.push_back(6 * (slopes[i] - slopes[i - 1]));
  }
  const auto inner = system.solve(std::move(rhs));
  std::copy(inner.begin(), inner.end(), bends.begin() + 1);
  return bends;
}

/// Second derivatives at the points of a closed spline; the two corner
/// elements of the cyclic system are handled by Sherman and Morrison's
/// formula.
std::vector<point> closed_bends(std::span<const double> chords,
                                std::span<const point> slopes) {
  const auto n = chords.size();
  tridiagonal system;
  std::vector<point> rhs;
  for (std::size_t i = 0; i < n; ++i) {
    const auto before = (i + n - 1) % n;
    system.diagonal.push_back(2 * (chords[before] + chords[i]));
    system.side.push_back(chords[i]);
    rhs.push_back(6 * (slopes[i] - slopes[before]));
  }
  const auto corner = chords[n - 1];
  const auto shift = -system.diagonal[0];
  std::vector<double> u(n);
  u.front() = shift;
  u.back() = corner;
  system.diagonal.front() -= shift;
  system.diagonal.back() -= corner * corner / shift;
  auto bends = system.solve(std::move(rhs));
  const auto z = system.solve(std::move(u));
  const auto factor = 1 / (1 + z.front() + corner / shift * z.back());
  const auto excess =
      factor * (bends.front() + (corner / shift) * bends.back());
  for (std::size_t i = 0; i < n; ++i)
    bends[i] = bends[i] - z[i] * excess;
  bends.push_back(bends.front());
  return bends;
}

} // namespace

double cubic_piece::length_m(double from, double to) const {
  constexpr auto node = 0.774596669241483377; // sqrt(3/5)
  const auto middle = 0.5 * (from + to), half = 0.5 * (to - from);
  auto speed = [&](double u) {
    const auto v = slope(u);
    return std::sqrt(dot(v, v));
  };
  return half / 9
         * (5 * speed(middle - node * half) + 8 * speed(middle)
            + 5 * speed(middle + node * half));
}

std::vector<cubic_piece> fit_spline(std::span<const point> points,
                                    bool closed) {
  check(points, closed);
  const auto n = points.size();
  const auto count = closed ? n : n - 1;
  std::vector<double> chords(count);
  std::vector<point> slopes(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = points[(i + 1) % n] - points[i];
    chords[i] = std::hypot(step.x_m, step.y_m);
    slopes[i] = (1 / chords[i]) * step;
  }
  const auto bends =
      closed ? closed_bends(chords, slopes) : open_bends(chords, slopes);
  std::vector<cubic_piece> pieces(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto h = chords[i];
    pieces[i] = {points[i], slopes[i] - (h / 6) * (2 * bends[i] + bends[i + 1]),
                 0.5 * bends[i], (1 / (6 * h)) * (bends[i + 1] - bends[i]), h};
  }
  return pieces;
}

} // namespace sofof
