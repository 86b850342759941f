// What becomes of a run whose results cannot be written.
#pragma once

namespace sofof {

enum class write_failure {
  ends_the_run,
  ends_the_files, ///< The run goes on without them, and has failed in the end.
};

} // namespace sofof
