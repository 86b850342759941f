// Files that are written whole, and lines that are added to some.
#pragma once

#include <filesystem>
#include <string_view>
#include <sys/types.h>

namespace sofof::network {

/// Writes a file at once: whoever sees it sees all of it, also after a crash.
/// @param mode  Who may read it from its first byte on, e.g. 0600.
/// @throws network_error when there is one already, or it cannot be written;
/// nothing is left behind then.
void create_file(const std::filesystem::path& path, std::string_view text,
                 mode_t mode);

/// The same in the place of a file that may be there already.
void replace_file(const std::filesystem::path& path, std::string_view text,
                  mode_t mode);

/// Adds a line to a file, which is made where it is missing.
/// @param mode  Of a new file.
/// @throws network_error when it cannot be written.
void append_to_file(const std::filesystem::path& path, std::string_view line,
                    mode_t mode);

} // namespace sofof::network
