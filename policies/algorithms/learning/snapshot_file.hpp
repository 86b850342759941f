// A file with what a learner has learned, and on what it was trained.
#pragma once

#include "policies/api/context.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::policies {

/// What such a file says of itself.
struct snapshot_header {
  std::string policy;                 ///< Name of the learner.
  std::string shape;                  ///< `snapshot_use::shape`.
  std::vector<std::string> scenarios; ///< Names, in the order of lessons.
  std::vector<std::string> changes;   ///< "KEY=VALUE", of all of them.
  std::int64_t first_seed = 0;        ///< Of each scenario,
  std::uint64_t seeds = 0;            ///< and how many from this one on.
  std::string program;                ///< Version of the program.
};

/// @param learned  What `policy::snapshot` gives.
/// @returns the text of the file; a line for each word of the header.
std::string snapshot_file(const snapshot_header& header,
                          std::string_view learned);

/// @returns what is behind the header, if the text has one.
std::string_view learned_in(std::string_view text);

/// Has a learner take up what such a file says.
/// @param text  Of the file.
/// @returns why the file is none for this policy, a sentence that starts with
/// the line; then all stays as it was.
std::optional<std::string> restore_from(std::string_view text,
                                        local_policy& policy);

} // namespace sofof::policies
