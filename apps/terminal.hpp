// How wide the reader's terminal is.
#pragma once

#include <cstddef>
#include <optional>
#include <sys/ioctl.h>
#include <unistd.h>

namespace sofof::apps {

/// @param descriptor  STDOUT_FILENO or STDERR_FILENO.
/// @returns columns; nothing for what is no terminal, where lines stay whole.
inline std::optional<std::size_t> terminal_width(int descriptor) {
  constexpr std::size_t usual = 80, least = 40;
  if (isatty(descriptor) == 0)
    return std::nullopt;
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return usual;
  return size.ws_col < least ? least : size.ws_col;
}

} // namespace sofof::apps
