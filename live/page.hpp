// The page that shows a run while it goes on, as apps/report has built it.
#pragma once

#include <string_view>

namespace sofof::live {

/// HTML; it asks for scene and events itself.
extern const std::string_view live_page;

} // namespace sofof::live
