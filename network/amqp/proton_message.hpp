// Messages as Qpid Proton has them, from and to ours.
#pragma once

#include "network/amqp/message.hpp"

#include <optional>
#include <proton/message.hpp>

namespace sofof::network::amqp {

/// @returns the message with its body as one binary section.
proton::message to_proton(const message& m);

/// @returns the application properties that have one of our types; others do
/// not count.
properties properties_of(const proton::message& m);

/// @returns the message; nothing when its body is no binary, or when Proton
/// cannot read it.
std::optional<message> from_proton(const proton::message& m);

} // namespace sofof::network::amqp
