// The story of one episode: how a service came to a provider, how it went, and
// why it ended.
#pragma once

#include "experiments/explain/episode.hpp"

#include <filesystem>
#include <string>

namespace sofof::experiments::explain {

/// @param folder    Of a run's results.
/// @param question  Without a time: the first episode that ended early, or
///                  else the longest.
/// @returns some ten lines of at most 80 columns, if names are short; a line
/// before them where no episode ran at the time; where there is no episode, the
/// run's headline and why.
/// @throws input_error when the folder knows of no such vehicle or service, or
/// is broken.
std::string tell(const std::filesystem::path& folder, const question& question);

} // namespace sofof::experiments::explain
