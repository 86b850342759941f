// What a sweep or a benchmark has in its folder so far.
#pragma once

#include <cstddef>
#include <filesystem>
#include <system_error>

namespace sofof::test {

/// @returns how many runs have ended.
inline std::size_t summaries_in(const std::filesystem::path& out) {
  std::size_t count = 0;
  std::error_code none;
  for (const auto& run :
       std::filesystem::directory_iterator{out / "runs", none})
    count += std::filesystem::exists(run.path() / "summary.json") ? 1U : 0U;
  return count;
}

} // namespace sofof::test
