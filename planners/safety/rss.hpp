// Responsibility-Sensitive Safety: the longest response time under which a
// distance is safe.
// Source: Shalev-Shwartz, Shammah, Shashua, "On a Formal Model of Safe and
// Scalable Self-driving Cars", arXiv 1708.06374v6.
#pragma once

#include "base/options/option_visitor.hpp"

namespace sofof::planners {

/// How vehicles move at worst in one direction; named after IEEE 2846-2022.
struct rss_motion {
  double accel_max_mps2 = 1.5; ///< While they respond.
  double brake_min_mps2 = 4;   ///< After that, until they stand.
  double brake_max_mps2 = 8;   ///< Of who is ahead.

  void visit_options(option_visitor& s) {
    s.field("accel_max_mps2", accel_max_mps2, {0.01, 20});
    s.field("brake_min_mps2", brake_min_mps2, {0.01, 20});
    s.field("brake_max_mps2", brake_max_mps2, {0.01, 20});
    if (brake_max_mps2 < brake_min_mps2)
      s.refuse("brake_max_mps2", "must not be less than `brake_min_mps2`.");
  }
};

/// What is assumed of the own vehicle and of others.
struct rss_assumptions {
  rss_motion lon{};              ///< Along the way.
  rss_motion lat{0.2, 0.8, 0.8}; ///< Across.
  double others_response_s = 1;  ///< > 0.

  void visit_options(option_visitor& s) {
    s.table("lon", [this](option_visitor& t) { lon.visit_options(t); });
    s.table("lat", [this](option_visitor& t) { lat.visit_options(t); });
    s.field("others_response_s", others_response_s, {0.01, 10});
  }
};

/// @returns the farthest place that a vehicle reaches which responds within a
/// time, accelerates until then, and brakes after that.
/// @param speed_mps   Any sign: of who moves away it is negative. Such a one
///                    stands at once when it responds; 0 is the farthest then.
/// @param response_s  ≥ 0.
double farthest_m(double speed_mps, double response_s, const rss_motion& of);

/// @returns the longest response time under which that place is not farther
/// than `room_m`; negative if there is no room even without one.
double longest_response_s(double speed_mps, double room_m,
                          const rss_motion& of);

/// Two vehicles, seen along the way of the one behind, or of either one if they
/// drive towards each other.
struct rss_gap {
  double gap_m = 0;     ///< Between their bodies; negative where they overlap.
  double own_mps = 0;   ///< Towards the other one, any sign.
  double other_mps = 0; ///< Away from the own one if it drives ahead (≥ 0),
                        ///< else towards it, any sign.
};

/// The own vehicle drives behind another one, which brakes at once as hard as
/// it can: definition 1, solved for the response time.
/// @returns seconds; negative: not safe under any.
double follows_safely_s(const rss_gap& x, const rss_motion& lon);

/// Both move towards each other, or would: definitions 2 (along the way) and 6
/// (across), solved for the own response time.
/// @returns seconds; negative: not safe under any.
double meets_safely_s(const rss_gap& x, const rss_motion& of,
                      double others_response_s);

} // namespace sofof::planners
