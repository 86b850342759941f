// One direction of a link.
#include "channel/link_direction.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sofof::channel {

link_direction::link_direction(channel_draws draws, direction to,
                               std::shared_ptr<shared_server_queue> cell)
    : draws_{std::move(draws)}, direction_{to}, cell_{std::move(cell)},
      stalls_{draws_.stalls()}, fades_{draws_.fades()} {}

passage link_direction::carry(time_point sent, message_class kind,
                              std::uint64_t number, std::size_t octets,
                              const std::optional<point>& vehicle) {
  const message_id m{direction_, kind, number};
  const auto airtime = draws_.airtime(m, octets);
  const auto queues = cell_ && airtime > duration{};
  const auto on_air = queues ? cell_->finish(sent, airtime) : sent + airtime;
  const auto stall = stalls_.at(sent);
  const auto fades = fades_.at(sent).has_value();
  if (draws_.is_out(direction_, sent - start_))
    return {std::nullopt, disturbance::outage};
  const auto here = draws_.quality_at(vehicle);
  if (draws_.lost(m, fades, here.loss))
    return {std::nullopt, disturbance::loss};
  const auto leaves = stall ? std::max(on_air, stall->end) : on_air;
  const auto late = draws_.overtaken_by(m);
  const auto delay =
      late
      + here.slowed(stall ? draws_.burst_delay(direction_, stall->number)
                          : draws_.network_delay(m, sent));
  auto arrives = leaves + delay;
  const auto is_overtaken = late > duration{};
  if (kind != message_class::digest && !is_overtaken) // else none is overtaken
    arrives = last_arrival_ = std::max(last_arrival_, arrives);
  const auto is_held = stall && stall->end > on_air;
  // Behind a slow one it is as late as that, since none overtakes.
  const auto is_slow = arrives - leaves >= slow_delay;
  passage through{arrives,
                  is_held   ? disturbance::stall
                  : is_slow ? disturbance::slow
                            : disturbance::none,
                  arrives - sent - airtime - delay, std::nullopt, is_overtaken};
  if (const auto after = draws_.copied_after(m))
    through.copy_arrives = arrives + *after;
  assert(through.wait >= duration{0});
  return through;
}

} // namespace sofof::channel
