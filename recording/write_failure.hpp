// What becomes of a run whose results cannot be written: decision 42.
#pragma once

namespace sofof::recording {

enum class write_failure {
  ends_the_run, ///< With an error: one process that simulates.
  /// The run goes on without them, and has failed in the end: hosts of a
  /// distributed run, whose cars drive (scenario/hosts.cpp).
  ends_the_files,
};

} // namespace sofof::recording
