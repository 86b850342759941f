// What docs/results.md says of a figure, a column or a reason, so that a report
// says the same.
#pragma once

#include <string>
#include <string_view>

namespace sofof::experiments::report {

/// All of docs/results.md.
extern const std::string_view results_page;

/// @param heading  Of a section whose table has names in its first column:
///                 "summary.json", "vehicles.csv", "Reasons".
/// @param name     As in the file: "latency_ms.mean". Of a figure without a row
///                 that of the object around it counts.
/// @returns what the table says of it, as plain text; empty if nothing.
std::string documented(std::string_view heading, std::string_view name);

} // namespace sofof::experiments::report
