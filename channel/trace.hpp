// Measured round trips, to be replayed.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace sofof::channel {

/// One sample of a measured round-trip file.
struct trace_sample {
  double at_s = 0;    ///< Since the first sample; never decreases.
  double delay_s = 0; ///< Round trip, >= 0.
};

/// Reads measured round trips. Two forms, told apart by the header line;
/// columns are separated by white space or commas:
/// * `pub_time(ms) sub_time(ms) delay(ms) ...`, as in the CICV5G data set
///   (Zhang et al. 2025, doi 10.5281/zenodo.17475688), further columns are
///   ignored;
/// * `time_s,delay_ms`.
/// @throws std::invalid_argument  with the line number, for another header, a
/// missing or negative number, a time before the one above it, or no samples.
std::vector<trace_sample> parse_trace(std::string_view text);

/// @param samples  At least one.
/// @param at_s     Since the first sample, >= 0. Beyond the last sample the
///                 trace starts again, one mean spacing after it.
/// @returns the round trip of the sample nearest in time, s: no value is
/// invented, so a replay keeps the distribution that was measured.
double replayed_delay_s(std::span<const trace_sample> samples, double at_s);

/// @returns how long one replay takes, s; 0 for a single sample.
double replay_length_s(std::span<const trace_sample> samples);

} // namespace sofof::channel
