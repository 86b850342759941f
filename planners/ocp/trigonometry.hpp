// Sine and cosine that the compiler can turn into vector code.
#pragma once

namespace sofof::planners::ocp {

/// Taylor polynomials of degree 15 and 16.
/// @param x  rad; the error is below 3e-15 for |x| <= 1, 6e-14 for 1.2.
template <class T>
constexpr auto sin_cos(T x) {
  const T z = x * x, zz = z * z, z4 = zz * zz;
  const T s0 = 1. - z * (1. / 6), s1 = 1. / 120 - z * (1. / 5040);
  const T s2 = 1. / 362880 - z * (1. / 39916800);
  const T s3 = 1. / 6227020800 - z * (1. / 1307674368000);
  const T c0 = 1. - z * (1. / 2), c1 = 1. / 24 - z * (1. / 720);
  const T c2 = 1. / 40320 - z * (1. / 3628800);
  const T c3 = 1. / 479001600 - z * (1. / 87178291200);
  const T c4 = T(1. / 20922789888000);
  struct {
    T sine, cosine;
  } both{x * (s0 + zz * s1 + z4 * (s2 + zz * s3)),
         c0 + zz * c1 + z4 * (c2 + zz * c3 + z4 * c4)};
  return both;
}

} // namespace sofof::planners::ocp
