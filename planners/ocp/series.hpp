// Coefficients along the horizon, of which those known when compiling cost
// nothing.
#pragma once

#include <array>
#include <concepts>

namespace sofof::planners::ocp {

/// Longest horizon.
inline constexpr int most_steps = 256;

/// @returns how many knots the loops over n knots touch: whole vector
/// registers of 4 doubles.
constexpr int padded(int n) {
  return (n + 3) / 4 * 4;
}

inline constexpr int capacity = padded(most_steps + 1);

/// A number a knot.
struct alignas(32) column : std::array<double, capacity> {};

/// Always 0. What it is multiplied with is never computed.
struct zero {};

/// Always 1.
struct one {};

template <class T>
concept number =
    std::same_as<T, double> || std::same_as<T, zero> || std::same_as<T, one>;

constexpr double value(double x) {
  return x;
}
constexpr double value(zero) {
  return 0;
}
constexpr double value(one) {
  return 1;
}

template <class A, class B>
concept symbolic = number<A> && number<B> && !(
    std::same_as<A, double> && std::same_as<B, double>);

template <class A, class B>
requires symbolic<A, B>
constexpr auto operator*(A a, B b) {
  if constexpr (std::same_as<A, zero> || std::same_as<B, zero>)
    return zero{};
  else if constexpr (std::same_as<A, one>)
    return b;
  else
    return a;
}

template <class A, class B>
requires symbolic<A, B>
constexpr auto operator+(A a, B b) {
  if constexpr (std::same_as<A, zero>)
    return b;
  else if constexpr (std::same_as<B, zero>)
    return a;
  else
    return value(a) + value(b);
}

/// What is known about a coefficient when compiling.
enum class entry { zero, one, constant, varying };

/// A coefficient, knot by knot.
template <entry kind>
class series {
public:
  double& operator[](int k) { return values_[k]; }
  double operator[](int k) const { return values_[k]; }

private:
  column values_{};
};

template <>
class series<entry::zero> {
public:
  zero operator[](int) const { return {}; }
};

template <>
class series<entry::one> {
public:
  one operator[](int) const { return {}; }
};

/// The same at every knot.
template <>
class series<entry::constant> {
public:
  double operator[](int) const { return value_; }
  void operator=(double x) { value_ = x; }

private:
  double value_ = 0;
};

/// Adds to a varying coefficient; adding a zero is no work.
inline void add(series<entry::varying>& to, int k, double x) {
  to[k] += x;
}

template <entry kind>
void add(series<kind>&, int, zero) {}

/// Sets a varying coefficient; one that is not has its value already.
inline void put(series<entry::varying>& to, int k, double x) {
  to[k] = x;
}

inline void put(series<entry::varying>& to, int k, zero) {
  to[k] = 0;
}

template <entry kind>
void put(series<kind>&, int, zero) {}

/// Adds to a sum; adding a zero is no work.
inline void gather(double& sum, double x) {
  sum += x;
}
inline void gather(double&, zero) {}

} // namespace sofof::planners::ocp
