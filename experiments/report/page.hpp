// The page that shows reports, as apps/report has built it.
#pragma once

#include <string_view>

namespace sofof::experiments::report {

/// HTML with `%title%` and `%document%` where these belong.
extern const std::string_view page;

} // namespace sofof::experiments::report
