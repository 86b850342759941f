// What judging takes of honest plans in a whole run.
#pragma once

namespace sofof::test {

/// Drives a scenario in virtual time, judges each plan once more, and prints
/// what that takes: of a plan, µs, and of the own plans that are compared with.
/// @param file     Of the scenario.
/// @param seconds  How long it lasts.
/// @returns 0.
/// @throws input_error with the place of the first mistake in the file.
int print_judging_times(const char* file, const char* seconds);

} // namespace sofof::test
