// A body that moves as was written down before.
#include "world/traffic/scripted_body.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::world {

scripted_body::scripted_body(station_id id, double length_m, double width_m,
                             std::vector<moment> moments)
    : id_{id}, length_m_{length_m}, width_m_{width_m}, moments_{
                                                           std::move(moments)} {
  assert(!moments_.empty());
  assert(std::ranges::is_sorted(moments_, {}, &moment::t_s));
}

std::optional<road_body> scripted_body::at(double t_s) const {
  const auto next = std::ranges::lower_bound(moments_, t_s, {}, &moment::t_s);
  if (next == moments_.end() || t_s < moments_.front().t_s)
    return std::nullopt;
  const auto& b = *next;
  const auto& a = next == moments_.begin() ? b : *(next - 1);
  const auto step_s = b.t_s - a.t_s;
  const auto share = step_s > 0 ? (t_s - a.t_s) / step_s : 1;
  const auto turn_rad = wrap_angle(b.heading_rad - a.heading_rad);
  return road_body{id_,
                   {a.at + share * (b.at - a.at),
                    wrap_angle(a.heading_rad + share * turn_rad), length_m_,
                    width_m_},
                   a.speed_mps + share * (b.speed_mps - a.speed_mps),
                   step_s > 0 ? (b.speed_mps - a.speed_mps) / step_s : 0};
}

} // namespace sofof::world
