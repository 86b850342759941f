// How long vehicles are in an area, from where they were.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"

#include <optional>
#include <span>

namespace sofof::experiments::study {

/// @param runs  With tracks.
/// @returns the mean time from entering the first provider's area to leaving
/// it, s, all vehicles together; nullopt when nobody did both.
/// @throws input_error when the run's files are broken.
std::optional<double>
mean_time_in_area_s(std::span<const measured_run* const> runs);

} // namespace sofof::experiments::study
