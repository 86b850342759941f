// A drive as a solution of CommonRoad.
#pragma once

#include "experiments/judge/ks_model.hpp"

#include <span>
#include <string>

namespace sofof::experiments::judge {

/// @param benchmark  The scenario's.
/// @param version    Of its format.
/// @param problem    The planning problem's id.
/// @param middle     Of the states' frame, in the scenario's.
/// @returns an XML file of a kinematic single-track trajectory of vehicle 2,
/// for the cost function SM1, which does not change it. It says nothing of
/// dates and computing times: the same drive makes the same bytes.
std::string solution_xml(const std::string& benchmark,
                         const std::string& version, const std::string& problem,
                         std::span<const ks_state> states, point middle);

} // namespace sofof::experiments::judge
