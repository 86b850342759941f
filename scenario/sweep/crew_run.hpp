// A run for another host: its files come in, the crew carries it out, and its
// results go out.
#pragma once

#include "actors/remote/workbench.hpp"
#include "scenario/sweep/crew.hpp"

#include <filesystem>
#include <memory>

namespace sofof {

/// @param folder  Made, and gone with the run.
/// @throws std::filesystem::filesystem_error when it cannot be made.
std::unique_ptr<ordered_run> make_crew_run(std::shared_ptr<crew> hands,
                                           std::filesystem::path folder);

} // namespace sofof
