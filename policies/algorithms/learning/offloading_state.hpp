// What learners see of a service that runs at a provider, or might.
#pragma once

#include "policies/api/context.hpp"

#include <array>
#include <cstddef>

namespace sofof::policies {

/// A service and one provider.
struct offloading_view {
  const local_context& context;
  const provider_view& provider;
  bool is_remote = false; ///< It runs there now; else in the vehicle.
  double radius_m = 300;  ///< Of the disc round the provider that counts.
};

/// Time that the planned path stays in the disc, at the present speed.
/// @returns s; infinity when standing in it.
double time_left_s(const offloading_view& view);

/// Cells of a table: four of the time left (< 2, 5, 15 s, more), five of the
/// forecast of the latency that 99 % stay below, in parts of the limit (< 0.5,
/// 0.8, 1, 1.5, more or unknown), four of the provider's utilisation (< 0.5,
/// 0.7, 0.9, more), and two of where it runs.
inline constexpr std::size_t offloading_cells = 160;

/// Grows by one when what a cell or a feature means changes: what was learned
/// before does not fit any more.
inline constexpr std::size_t offloading_version = 1;

/// @returns the cell, below `offloading_cells`.
std::size_t cell_of(const offloading_view& view);

/// The same and more as numbers from 0 to 1.
inline constexpr std::size_t offloading_features = 12;

/// @returns time left (of 15 s), distance (of twice the radius), speed (of
/// 25 m/s), probabilities to be late and of a gap, latencies that 50 % and 99 %
/// stay below and the computing time (of twice the limit), utilisation (of 2),
/// energy (of twice that on board), whether it runs there, and how long it has
/// been where it is (of 10 s).
std::array<double, offloading_features>
features_of(const offloading_view& view);

} // namespace sofof::policies
