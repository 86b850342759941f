// Physical quantities as ETSI messages carry them: whole numbers of a unit,
// with numbers that mean "out of range" and "unavailable".
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace sofof::messages::etsi {

/// How a quantity in SI units becomes an integer. All of TS 102 894-2 V1.3.1
/// unless another source is named.
struct quantity {
  double step;     ///< SI value of 1.
  int low, high;   ///< What stands for a value.
  int below;       ///< Stands for everything below `low`; may be `low`.
  int above;       ///< Stands for everything above `high`; may be `high`.
  int unavailable; ///< Equals `above` where there is no such number.

  /// @returns the nearest integer; `unavailable` for NaN.
  int to_wire(double si) const { return code(round(si / step), si); }

  /// The same for a bound on an error, which never gets smaller.
  int to_wire_at_least(double si) const {
    constexpr auto rounding = 1e-9;
    return code(std::ceil(si / step * (1 - rounding)), si);
  }

  int to_wire(std::optional<double> si) const {
    return si ? to_wire(*si) : unavailable;
  }

  /// @returns nothing for what is unavailable, out of range, or no such
  /// quantity.
  constexpr std::optional<double> to_si(int wire) const {
    if (wire < low || wire > high)
      return {};
    return wire * step;
  }

private:
  static double round(double x) {
    return std::floor(x + 0.5); // ties up: the same on every host
  }
  constexpr int code(double steps, double si) const {
    if (si != si)
      return unavailable;
    return steps < low ? below : steps > high ? above : static_cast<int>(steps);
  }
};

/// Values beyond the ends count as the ends.
constexpr quantity clamped(double step, int low, int high, int unavailable) {
  return {step, low, high, low, high, unavailable};
}

/// Values below `low` count as it, values above `high` are out of range.
constexpr quantity ranged(double step, int low, int high, int out_of_range,
                          int unavailable) {
  return {step, low, high, low, out_of_range, unavailable};
}

inline constexpr double degree_rad = std::numbers::pi / 180;

// Motion.
inline constexpr auto speed_mps = clamped(0.01, 0, 16382, 16383);
inline constexpr auto accel_mps2 = clamped(0.1, -160, 160, 161);
inline constexpr auto curvature_1pm = clamped(1e-4, -1023, 1022, 1023);
inline constexpr auto yaw_rate_radps =
    clamped(0.01 * degree_rad, -32766, 32766, 32767);
/// Velocity components (CPM).
inline constexpr auto velocity_mps = clamped(0.01, -16383, 16382, 16383);

// Sizes and distances.
inline constexpr auto vehicle_length_m = ranged(0.1, 1, 1021, 1022, 1023);
inline constexpr auto vehicle_width_m = ranged(0.1, 1, 60, 61, 62);
/// Length and width of a road user (MCM: no number means "unavailable").
inline constexpr auto road_user_size_m = clamped(0.1, 1, 62, 62);
inline constexpr auto altitude_m = clamped(0.01, -100000, 800000, 800001);
/// Of an object from the station, CPM TR 103 562 and TS 103 324.
inline constexpr auto cpm_tr_distance_m =
    clamped(0.01, -132768, 132767, 132767);
inline constexpr auto cpm_ts_distance_m =
    clamped(0.01, -131072, 131071, 131071);
inline constexpr auto cpm_tr_size_m = clamped(0.1, 0, 1023, 1023);
inline constexpr auto cpm_ts_size_m = clamped(0.1, 1, 255, 256);
/// Of a waypoint from the reference position, MCM.
inline constexpr auto mcm_distance_m = clamped(0.01, -131071, 131071, -131072);

// Errors at 95 % confidence: encode with `to_wire_at_least`.
inline constexpr auto speed_confidence_mps = ranged(0.01, 1, 125, 126, 127);
inline constexpr auto heading_confidence_rad =
    ranged(0.1 * degree_rad, 1, 125, 126, 127);
inline constexpr auto accel_confidence_mps2 = ranged(0.1, 0, 100, 101, 102);
inline constexpr auto semi_axis_m = ranged(0.01, 0, 4093, 4094, 4095);
/// CPM TR 103 562: distances in cm, sizes in 0.1 m.
inline constexpr auto distance_confidence_m = ranged(0.01, 0, 100, 101, 102);
inline constexpr auto size_confidence_m = ranged(0.1, 0, 100, 101, 102);

/// An angle in tenths of a degree, 0..3599; 3601 is unavailable. Its zero and
/// sense are the caller's business.
inline constexpr int unavailable_angle = 3601;

inline int angle_to_wire(double angle_rad) {
  constexpr double circle = 3600;
  const auto tenths = angle_rad / (0.1 * degree_rad);
  if (!(std::abs(tenths) < 1e12)) // also NaN
    return unavailable_angle;
  const auto laps = std::floor(tenths / circle);
  // Not negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
  const auto rounded = static_cast<int>(tenths - laps * circle + 0.5);
  return rounded < 3600 ? rounded : 0;
}

/// @returns radians in [0, 2 pi].
constexpr std::optional<double> angle_to_rad(int wire) {
  if (wire < 0 || wire > 3600)
    return {};
  return wire * (0.1 * degree_rad);
}

/// A confidence that is the index of the first bound that is large enough;
/// beyond the last it is out of range, and the index after that means
/// unavailable.
template <std::size_t N>
struct grades {
  std::array<double, N> bounds; ///< SI, rising.

  constexpr int to_wire(double si) const {
    if (si != si)
      return unavailable();
    constexpr auto rounding = 1e-9;
    std::size_t i = 0;
    while (i < N && bounds[i] < si * (1 - rounding))
      ++i;
    return static_cast<int>(i);
  }

  constexpr std::optional<double> to_si(int wire) const {
    if (wire < 0 || wire >= static_cast<int>(N))
      return {};
    return bounds[static_cast<std::size_t>(wire)];
  }

  static constexpr int out_of_range() { return N; }
  static constexpr int unavailable() { return N + 1; }
};

inline constexpr grades<6> curvature_confidence_1pm{
    {2e-5, 1e-4, 5e-4, 2e-3, 1e-2, 1e-1}};
inline constexpr grades<7> yaw_rate_confidence_radps{
    {0.01 * degree_rad, 0.05 * degree_rad, 0.1 * degree_rad, 1 * degree_rad,
     5 * degree_rad, 10 * degree_rad, 100 * degree_rad}};
inline constexpr grades<14> altitude_confidence_m{
    {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200}};

} // namespace sofof::messages::etsi
