// Computing times of a program, measured once.
#pragma once

#include "base/time.hpp"

#include <filesystem>
#include <memory>
#include <vector>

namespace sofof::actors {

/// @param file  A computing time in ms in each line, > 0 and at most 60 000;
///              lines that begin with # are for readers.
/// @returns them in their order; not empty.
/// @throws std::invalid_argument in words for the user.
std::shared_ptr<const std::vector<duration>>
read_run_times(const std::filesystem::path& file);

} // namespace sofof::actors
