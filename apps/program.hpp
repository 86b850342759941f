// Which program this is.
#pragma once

#include "base/fingerprint.hpp"
#include "base/options/toml_file.hpp"

#include <fmt/format.h>

#include <string>

namespace sofof::apps {

/// The file that this process runs.
inline constexpr auto program_file = "/proc/self/exe";

/// @returns its version and a fingerprint: another build may give other
/// results.
inline std::string this_program() {
  constexpr std::size_t longest_program = std::size_t{1} << 30;
  const auto text = read_text(program_file, longest_program);
  return fmt::format("{} {:016x}", SOFOF_VERSION,
                     fingerprint(text.value_or("")));
}

} // namespace sofof::apps
