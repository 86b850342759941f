// A scenario as processes of one host: software in the loop, as the paper
// tests.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace sofof::experiments {

struct sil_options {
  std::filesystem::path program;      ///< `sofof` itself.
  std::string scenario;               ///< Its file.
  std::vector<std::string> changes;   ///< Words for all that read it.
  std::vector<std::string> for_cars;  ///< Words for the cars alone.
  std::vector<std::string> providers; ///< Their names; at least one.
  bool directly = false;     ///< Without a broker: cars connect to providers.
  std::filesystem::path out; ///< A folder that is there, for all results.
};

/// Starts a broker, a process for each provider, and one for all cars (cars of
/// several processes would not see each other), waits until the cars have
/// driven, and ends them all. Everything is on loopback, at ports that nobody
/// else has. Each has a folder of its results, `cars` that of the cars, and a
/// file of what it said.
/// @param console  Gets what the cars say, and what goes wrong with others.
/// @returns the exit code: that of the cars, 1 when another process did not
/// start, ended too early or not in good order, 130 when it was interrupted
/// before the cars drove.
int run_sil(const sil_options& what, const std::atomic<bool>& interrupted,
            std::ostream& console);

} // namespace sofof::experiments
