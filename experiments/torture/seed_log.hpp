// Which seeds have been tried, and what came out: a line each.
#pragma once

#include "experiments/torture/tally.hpp"
#include "experiments/torture/trial.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace sofof::experiments::torture {

/// What is known of a seed.
struct tried_seed {
  tally counts;
  std::string broken;  ///< The promises that it breaks; empty if all is well.
  std::string program; ///< That tried it.
};

/// The seeds of a folder: `seeds.csv`, or one such file for each shard. Files
/// of several machines may be put into one folder: what they say adds up.
class seed_log {
public:
  /// Reads all files of the folder. A line that was cut off counts for nothing.
  /// @param own      Name of the file that is written, "seeds.csv".
  /// @param program  Is noted with each seed.
  /// @throws input_error when a file is none of these, or cannot be read.
  seed_log(const std::filesystem::path& folder, std::string_view own,
           std::string program);

  /// Adds a line, at once, and as a whole. Of a seed that was tried before the
  /// newer line counts.
  /// @throws input_error when it cannot be written.
  void add(std::uint64_t seed, const verdict& v);

  bool knows(std::uint64_t seed) const { return seeds_.contains(seed); }
  const std::map<std::uint64_t, tried_seed>& seeds() const { return seeds_; }

  /// @returns all together.
  tally sum() const;

private:
  void read(const std::filesystem::path& file);

  std::filesystem::path own_;
  std::string program_;
  std::map<std::uint64_t, tried_seed> seeds_;
};

} // namespace sofof::experiments::torture
