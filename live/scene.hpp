// What does not change while a run goes on.
#pragma once

#include "scenario/live_view.hpp"

#include <string>
#include <string_view>

namespace sofof::live {

/// @param run  Which run it is, as its frames say it.
/// @returns map, areas, providers and names, as JSON; lanes and areas as in the
/// drives of a report.
std::string scene_text(const scenario::live_subject& of, std::string_view run);

} // namespace sofof::live
