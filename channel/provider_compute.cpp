// A provider's computers: how many there are, and how long each takes.
#include "channel/provider_compute.hpp"

#include "channel/draw_lanes.hpp"

#include <cassert>
#include <cmath>

namespace sofof::channel {

using namespace std::chrono_literals;

duration provider_compute::computing_time(const random_stream& draws,
                                          std::uint64_t cycle,
                                          double demand) const {
  assert(demand >= 0);
  assert(joint_share >= 0 && joint_share <= 1);
  assert(more_computing >= duration{0});
  const auto one =
      more_computing
      + from_seconds(alone.draw_s(draws, cycle, computing_lane)
                     + joint_share * joint.draw_s(draws, cycle, joint_lane));
  return from_seconds(to_seconds(one) * demand);
}

double provider_compute::mean_s() const {
  return alone.mean_s() + joint_share * joint.mean_s()
         + to_seconds(more_computing);
}

double provider_compute::deviation_s() const {
  return std::hypot(alone.deviation_s(), joint_share * joint.deviation_s());
}

draw_bound provider_compute::bound() const {
  const auto a = alone.bound();
  const auto b = joint.bound();
  // Rounded as `computing_time` rounds; what exceeds the sum exceeds a part.
  return {to_seconds(more_computing
                     + from_seconds(a.at_most_s + joint_share * b.at_most_s)),
          a.probability + b.probability, a.beyond_s + joint_share * b.beyond_s};
}

provider_compute compute_measured_with(std::string_view profile) {
  provider_compute c;
  c.model = profile;
  if (profile == "paper_sim" || profile == "paper_sim_correlated") {
    // A light tail: docs/channels.md.
    c.joint = delay_distribution::beta(45ms, 0.646, 2.11);
    c.joint_share = 0.3;
    if (profile == "paper_sim_correlated")
      c.joint = c.joint.kept(0.9);
  } else if (profile == "paper_5g") {
    c.workers = 2;
    c.alone = delay_distribution::lognormal(0ms, 3ms, 1ms);
  } else if (profile == "spiky_5g") {
    c.workers = 8;
    c.alone = delay_distribution::lognormal(0ms, 3ms, 1ms);
  }
  return c;
}

} // namespace sofof::channel
