// That a station has come to be doubted, and why.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sofof::planners {

/// What a body failed at.
enum class doubt_check : std::uint8_t {
  jump,    ///< It is not where its motion leads.
  sight,   ///< It lies open to sensors that do not see it.
  overlap, ///< It is where a body is that others see.
  sender,  ///< Sight, and its sender has told of such bodies before.
};

inline constexpr std::string_view name_of(doubt_check x) {
  constexpr std::string_view names[] = {"jump", "sight", "overlap", "sender"};
  return names[static_cast<std::size_t>(x)];
}

/// A station has come to be doubted, or is no longer.
struct station_doubt {
  time_point at;
  station_id station = 0; ///< Who tells of the body.
  bool begins = true;
  doubt_check check{}; ///< This and the rest: of one that begins.
  double value = 0;    ///< m off (jump), else for so many seconds.
  double limit = 0;
};

} // namespace sofof::planners
