// The scenario that `sofof new` begins with.
#pragma once

#include <string_view>

namespace sofof::apps {

/// NAME stands in it wherever its name belongs.
extern const std::string_view new_scenario_text;

} // namespace sofof::apps
