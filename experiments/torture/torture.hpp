// Tries seed after seed, on several cores, and keeps what it finds.
#pragma once

#include "experiments/sweep/shard.hpp"
#include "experiments/torture/trial.hpp"
#include "recording/progress.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace sofof::experiments::torture {

struct torture_options {
  /// Gets the log of seeds, and a folder `findings`.
  std::filesystem::path out;
  std::string program;       ///< Is noted with each seed.
  unsigned jobs = 1;         ///< Runs at the same time, >= 1.
  std::uint64_t first = 1;   ///< Seeds from here
  std::uint64_t last = 1;    ///< up to here, both included, are tried,
  std::optional<shard> part; ///< but those of other shards,
  std::string with;          ///< and those whose scenario lacks these words,
  bool again = false;        ///< and, unless this is set, those in the log,
  /// until the log has so many hours of vehicles of these, if any; of a shard
  /// its part of them.
  std::optional<double> hours;
  std::size_t most_tries = 300; ///< Of making one finding small.
  recording::progress::output show = recording::progress::output::quiet;
};

struct torture_outcome {
  std::size_t tried = 0;    ///< Seeds, in this call,
  std::size_t findings = 0; ///< Seeds of the log that break a promise.
  bool interrupted = false;
};

/// Tries seeds. One that breaks a promise is told at once, with the line that
/// repeats it, and made small: findings/SEED gets the scenario as it was drawn,
/// the small one with its results, and what is broken. In the end a table of
/// all that the log of the folder has is told. Precondition: this process has
/// one thread.
/// @param interrupted  Once true, it ends soon; what is finished is kept.
/// @throws input_error when the log cannot be read or written.
torture_outcome try_seeds(const torture_options& how,
                          const std::atomic<bool>& interrupted,
                          std::ostream& console);

/// Tries a scenario of one's own, and tells what it breaks; `out`/run has its
/// results then.
/// @throws input_error when it cannot be loaded.
torture_outcome try_scenario(const tried_scenario& what,
                             const std::filesystem::path& out,
                             std::ostream& console);

} // namespace sofof::experiments::torture
