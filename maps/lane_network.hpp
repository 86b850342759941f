// Makes a network that can be driven of what a source says.
#pragma once

#include "maps/source_map.hpp"

namespace sofof::maps {

/// Drops what leads nowhere and joins what is too short to be a lane:
/// * lanes of junctions that nobody comes to or from, and parts of less than
///   50 m that nothing else is joined to;
/// * the halves of a way through a junction become one lane;
/// * lanes shorter than a metre become parts of those before or behind them;
/// * lanes shorter than a centimetre that cannot be joined are dropped.
/// Each of them is counted in `left_out`.
void tidy(source_map& map);

} // namespace sofof::maps
