// Files that only their owner may read.
#pragma once

#include <filesystem>

namespace sofof::network {

/// Refuses a file that its group or all may read, change or run. One that is
/// not there is for others to refuse.
/// @throws network_error, which says how to mend it.
void check_secret(const std::filesystem::path& file);

} // namespace sofof::network
