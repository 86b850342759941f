// Whether this program speaks AMQP.
#pragma once

#include "network/network_error.hpp"

namespace sofof::network::amqp {

/// @returns whether Qpid Proton was there when it was built; else clients and
/// brokers throw when they are made.
bool is_built_in();

/// @throws network_error where it is not, with what to do.
inline void require_built_in() {
  if (!is_built_in())
    throw network_error{"this program was built without AMQP; install "
                        "libqpid-proton-cpp12-dev and build it again with "
                        "./sofof setup"};
}

} // namespace sofof::network::amqp
