// Each writes a drive in one format.
#pragma once

#include "experiments/convert/recorded_drive.hpp"

#include <functional>
#include <string_view>

namespace sofof::experiments::convert {

/// Takes what is written, piece by piece.
using sink = std::function<void(std::string_view)>;

/// Frames that move with cars, the scene, places on Earth, states, results of
/// providers and events, by time.
void write_mcap(const recorded_drive& drive, const sink& put);

/// All cars at once, at equal times: rows of different cars are not of the same
/// times, so places between two rows of a car are on a line.
void write_fcd(const recorded_drive& drive, const sink& put);

/// Lanes and areas, then the ways of cars: a line for each stretch that was
/// planned on one side.
void write_geojson(const recorded_drive& drive, const sink& put);

/// When results of trajectory planning came, s, and after which latency, ms: a
/// trace as a channel replays it (`network.trace`).
void write_latencies(const recorded_drive& drive, const sink& put);

} // namespace sofof::experiments::convert
