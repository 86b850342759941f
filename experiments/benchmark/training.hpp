// A policy that learns by driving.
#pragma once

#include "recording/progress.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments::bench {

/// Seeds from here on are for training: policies are judged by those from 1 on.
inline constexpr std::int64_t first_training_seed = 1000;

struct training_options {
  std::vector<std::filesystem::path> scenarios; ///< At least one.
  std::string policy;           ///< An LODM with an option `learning`.
  std::vector<std::string> set; ///< "KEY=VALUE", in all drives.
  std::size_t seeds = 1;        ///< From `first_training_seed` on, >= 1.
  std::filesystem::path out;    ///< Gets the snapshot.
  std::string version;          ///< Of this program, for the snapshot.
  recording::progress::output show = recording::progress::output::quiet;
};

/// Drives all scenarios with the first seed, then all with the next one, in
/// virtual time; everybody in all of them teaches one mind, which is written,
/// behind a header that says on what it was trained, when the last drive has
/// ended. The same options give the same snapshot.
/// @returns whether it came to its end; else no file is written.
/// @throws input_error when a file is missing or wrong, the policy does not
///         learn, or the snapshot cannot be written;
///         programs::program_error when a program that decides fails.
bool train(const training_options& options,
           const std::atomic<bool>& interrupted, std::ostream& console);

} // namespace sofof::experiments::bench
