// What pages of docs say of a figure, a column or a reason, so that a report
// says the same.
#pragma once

#include <string>
#include <string_view>

namespace sofof::experiments::report {

/// All of docs/results.md, and of docs/bench.md.
extern const std::string_view results_page;
extern const std::string_view bench_page;

/// @param cell  Of a table in Markdown.
/// @returns its text without mark-up; of links what is to be read.
std::string plain_text(std::string_view cell);

/// @param heading  Of a section of `page` whose table has names in its first
///                 column.
/// @returns what the table says of a name, as plain text; empty if nothing.
std::string documented_in(std::string_view page, std::string_view heading,
                          std::string_view name);

/// The same in docs/results.md.
/// @param heading  "summary.json", "vehicles.csv", "Reasons" …
/// @param name     As in the file: "latency_ms.mean". Of a figure without a row
///                 that of the object around it counts.
std::string documented(std::string_view heading, std::string_view name);

} // namespace sofof::experiments::report
