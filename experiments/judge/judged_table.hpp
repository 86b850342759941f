// What was judged, for people and for programs.
#pragma once

#include "experiments/judge/judge.hpp"
#include "experiments/report/document.hpp"

#include <span>
#include <string>

namespace sofof::experiments::judge {

/// The columns of a console's table.
std::string table_head();
std::string table_line(const judged& row);

/// @returns how many there are of each result, in a few lines.
std::string summary(std::span<const judged> rows);

/// @returns a line for each row, with a head.
std::string to_csv(std::span<const judged> rows);

/// @returns a report over a collection.
report::document judged_page(std::span<const judged> rows);

} // namespace sofof::experiments::judge
