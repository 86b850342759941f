// The standard normal law: how likely, and how far out.
#pragma once

namespace sofof::policies {

/// @returns P(X ≤ x) of a standard normal X; relative error of that of
/// `std::erfc`, some 1e-15, in both tails.
double normal_cdf(double x);

/// The x with `normal_cdf(x)` = p.
/// @param p  In [0, 1]; 0 and 1 give the infinities, anything else no number.
/// @returns x with an absolute error below 1e-12 for p from 1e-300 to 0.5, and
/// to 1 - p from 1e-300 to 0.5 as far as the digits of p allow: near 1 they are
/// what limits it (1e-5 at p = 1 - 1e-12).
/// Source: start from Abramowitz & Stegun 1964, 26.2.23; then Halley's method.
double normal_quantile(double p);

} // namespace sofof::policies
