// A channel that carries nothing for a time.
#pragma once

#include "channel/channel_profile.hpp"

#include <memory>

namespace sofof::channel {

/// @returns the channel with one more outage: nothing gets through between
/// these times since the start of the run.
inline std::shared_ptr<const channel_profile>
with_outage(channel_profile channel, duration from, duration to) {
  channel.outages.push_back({from, to});
  return std::make_shared<const channel_profile>(std::move(channel));
}

} // namespace sofof::channel
