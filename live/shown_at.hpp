// Has a run shown while it goes on.
#pragma once

#include "network/network_address.hpp"
#include "scenario/run.hpp"

namespace sofof::live {

/// @returns what shows a run in browsers that ask at an address.
scenario::live_view_maker shown_at(const network::network_address& at);

} // namespace sofof::live
