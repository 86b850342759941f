// When something is worth another message: what CAMs and CPMs have in common.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <numbers>

namespace sofof::messages {

/// When messages are sent.
enum class generation_rule : std::uint8_t {
  triggered,  ///< When there is news, as ETSI asks.
  fixed_10hz, ///< All there is to tell, every 100 ms.
};

namespace generation {

/// Between two messages of a kind at least (T_GenCamMin, T_GenCpmMin) ...
inline constexpr duration shortest = std::chrono::milliseconds{100};
/// ... and at most (T_GenCamMax, T_GenCpmMax). Source: EN 302 637-2, section
/// 6.1.3; TS 103 324, section 6.1.2.
inline constexpr duration longest = std::chrono::milliseconds{1000};

/// What is news: more than this since it was told last.
/// Source: EN 302 637-2, section 6.1.3; TS 103 324, section 6.1.2.3.
inline constexpr double moved_m = 4;
inline constexpr double faster_mps = 0.5;
inline constexpr double turned_rad = 4 * std::numbers::pi / 180;

} // namespace generation

/// How something moves, as far as the rules look at it.
struct told_motion {
  point position; ///< Of the same point of it each time, m, east-north.
  double heading_rad = 0;
  double speed_mps = 0;
};

/// @returns whether something has moved, turned or changed its speed so much
/// since `told` that others have to know; never for what is not a number.
bool is_news(const told_motion& told, const told_motion& now);

} // namespace sofof::messages
