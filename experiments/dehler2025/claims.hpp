// What the paper claims, and what our figures make of it.
#pragma once

#include "experiments/dehler2025/paper_figures.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::study {

/// What figures say of one part of a claim.
enum class finding {
  holds,
  open,    ///< They show neither this nor its opposite.
  opposite ///< They show that it is otherwise.
};

/// What is said of a claim in the end.
enum class verdict {
  not_measured,
  reproduced,     ///< All parts hold.
  in_part,        ///< Some do.
  not_reproduced, ///< None does, and none is shown to be otherwise.
  contradicts     ///< None does, and one is shown to be otherwise.
};

/// @returns what the findings of a claim's parts make together; without any,
/// `not_measured`.
verdict verdict_of(std::span<const finding> parts);

/// @returns "reproduced", "in part", "not reproduced", "contradicts", or "not
/// measured".
std::string_view word_of(verdict v);

/// A claim that is computed. What it says, and its tolerance, are in
/// config/paper/text/verdicts.md under its name.
struct judged_claim {
  std::string name;
  std::string ours; ///< Our figures, for people.
  verdict word = verdict::not_measured;
};

/// Tolerances of the claims, chosen before the runs, but for the part of chance
/// in `latency_grows`. All of them are ours: the
/// paper has none.
namespace tolerance {

/// Of the height at which curves saturate, and of the time in the area.
inline constexpr double height = 0.1;
/// Of the last two points of a curve that has saturated.
inline constexpr double plateau = 0.05;
/// Where curves rise: between these shares of their height.
inline constexpr double rising_from = 0.1, rising_to = 0.9;
/// How many times as high a curve ends as it begins.
inline constexpr double rise_times = 10;
/// From which on a deviation has grown.
inline constexpr double grown = 0.01;
/// Of a fitted mean or deviation.
inline constexpr double fitted = 0.05;
/// "Nearly all": at most this share is late; from `many_late` on it is not.
inline constexpr double few_late = 0.01, many_late = 0.05;
/// A rate within a factor of two is open when its interval misses the paper's.
inline constexpr double rate_times = 2;
/// Jumps that nobody notices, and such that everybody does.
inline constexpr double quiet_jump_mps = 0.1, loud_jump_mps = 0.5;
inline constexpr double quiet_jump_mps2 = 0.3, loud_jump_mps2 = 1.5;
/// A share of a core within this factor holds, beyond the other it is another.
inline constexpr double cost_times = 2, other_cost_times = 5;
/// "Negligible", percent of a core; from `much_v2x` on it is not.
inline constexpr double little_v2x = 1, much_v2x = 5;
/// The share of the time from which on offloading pays, the same.
inline constexpr double pays_times = 1.5, other_pays_times = 2;

} // namespace tolerance

/// @returns all computed claims, in the order of the paper.
std::vector<judged_claim> judge(const paper_figures& f);

} // namespace sofof::experiments::study
