// Results that come from another host, on their way to the disk.
#pragma once

#include "messages/work.hpp"
#include "scenario/output_file.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

namespace sofof {

/// Writes the files of a run into a folder, and nothing else, whatever a peer
/// sends. The summary comes last, when all is there.
class result_files {
public:
  /// Removes the files of an earlier run.
  /// @param folder  Made where it is missing.
  /// @throws input_error, as all members do when it cannot be written.
  explicit result_files(std::filesystem::path folder);

  /// @returns why this part cannot be one of a run's results, as words about
  /// its sender; nothing if it was taken.
  std::optional<std::string> take(const file_piece& piece);

  /// @returns why the results are not complete; nothing if they are.
  std::optional<std::string> finish();

private:
  std::filesystem::path folder_;
  std::set<std::string> met_;
  std::string current_; ///< The name of the file that comes now.
  std::optional<output_file> file_;
  std::string summary_;
  std::uint64_t octets_ = 0;
};

} // namespace sofof
