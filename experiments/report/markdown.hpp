// A report as text, for a repository.
#pragma once

#include "experiments/report/document.hpp"

#include <string>

namespace sofof::experiments::report {

/// @returns the document as Markdown: figures as tables of their points where
/// these are few, else by their names; drives and listings are left out.
std::string markdown(const document& what);

} // namespace sofof::experiments::report
