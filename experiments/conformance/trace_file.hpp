// A run's protocol_trace.csv, read step by step.
#pragma once

#include "base/time.hpp"
#include "experiments/conformance/trace_checker.hpp"

#include <cstddef>
#include <filesystem>

namespace sofof::experiments::conformance {

/// @param folder  Of a run with `record.trace`; of one that was killed, too.
/// @returns its file.
std::filesystem::path trace_file_of(const std::filesystem::path& folder);

/// @returns how late timers of the run could be: zero in virtual time.
/// @throws input_error when its summary is broken.
duration slack_of(const std::filesystem::path& folder);

/// @returns which of SOFOF's services follow which in a chain.
services_before chain_of_services();

/// Gives all steps of a run to a checker.
/// @param number  Of the trace, for `trace_place`.
/// @throws input_error with file and line when the run has no trace, or a line
/// is not as docs/trace.md says.
void read_trace(const std::filesystem::path& folder, std::size_t number,
                trace_checker& to);

} // namespace sofof::experiments::conformance
