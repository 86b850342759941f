// Which program this is.
#pragma once

#include "scenario/toml_file.hpp"
#include "world/fingerprint.hpp"

#include <fmt/format.h>

#include <string>

namespace sofof {

/// The file that this process runs.
inline constexpr auto program_file = "/proc/self/exe";

/// @returns its version and a fingerprint: another build may give other
/// results.
inline std::string this_program() {
  const auto text = read_text(program_file);
  return fmt::format("{} {:016x}", SOFOF_VERSION,
                     fingerprint(text.value_or("")));
}

} // namespace sofof
