// Files that are written whole, and never over others.
#pragma once

#include <filesystem>
#include <string_view>
#include <sys/types.h>

namespace sofof {

/// Writes a file at once: whoever sees it sees all of it, also after a crash.
/// @param mode  Who may read it from its first byte on, e.g. 0600.
/// @throws network_error when there is one already, or it cannot be written;
/// nothing is left behind then.
void write_new_file(const std::filesystem::path& path, std::string_view text,
                    mode_t mode);

} // namespace sofof
