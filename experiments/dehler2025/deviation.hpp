// How far two drives of the same vehicle are apart.
#pragma once

#include "experiments/dehler2025/measured_run.hpp"

namespace sofof::experiments::study {

/// At the same places of the way, where the first run was offloaded; all
/// vehicles together.
struct deviation {
  double path_rms_m = 0;
  double path_max_m = 0;
  double speed_rms_mps = 0;
  double speed_max_mps = 0;
  double samples = 0;
};

/// @param offloaded, local  Of the same seed; with tracks.
/// @returns how `offloaded` differs from `local` in lateral offset and speed.
/// @throws input_error when a file is missing or broken.
deviation deviation_between(const measured_run& offloaded,
                            const measured_run& local);

} // namespace sofof::experiments::study
