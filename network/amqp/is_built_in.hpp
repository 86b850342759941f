// Whether this program speaks AMQP.
#pragma once

namespace sofof::network::amqp {

/// @returns whether Qpid Proton was there when it was built; else clients and
/// brokers throw when they are made.
bool is_built_in();

} // namespace sofof::network::amqp
