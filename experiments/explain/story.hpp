// The story of one episode: how a service came to a provider, how it went, and
// why it ended.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sofof::experiments::explain {

/// Which episode.
struct question {
  std::optional<std::uint64_t> station; ///< Any, if not said.
  std::optional<double> at_s; ///< The one that runs then, or is nearest.
  std::string service;        ///< Any, if empty.
};

/// @param folder    Of a run's results.
/// @param question  Without a time: the first episode that ended early, or
///                  else the longest.
/// @returns some ten lines of at most 80 columns, if names are short.
/// @throws input_error when the folder holds no such episode, or is broken.
std::string tell(const std::filesystem::path& folder, const question& question);

} // namespace sofof::experiments::explain
