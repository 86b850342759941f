// Counting stops.
#include "world/vehicle/trip.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::world {
namespace {

/// A car rests below, and has moved above; what creeps in a queue does neither.
constexpr double rests_mps = 0.1, moves_mps = 1;

} // namespace

void stop_meter::add(double speed_mps, double step_s) {
  assert(speed_mps >= 0 && step_s > 0);
  if (speed_mps > moves_mps) {
    has_moved_ = true;
    stood_s_ = 0;
  }
  if (speed_mps > rests_mps)
    return;
  if (has_moved_) {
    has_moved_ = false;
    ++count_;
  }
  if (count_ == 0)
    return; // it has not set off yet
  stood_s_ += step_s;
  longest_s_ = std::max(longest_s_, stood_s_);
}

} // namespace sofof::world
