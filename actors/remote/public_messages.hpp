// The messages that processes may send each other.
#pragma once

#include "actors/remote/frame_check.hpp"

namespace sofof::actors {

/// @returns what a process of vehicles may send to a provider's: what the
/// interfaces of acceptor, handshake and provider endpoint take.
const message_forms& messages_to_provider();

/// @returns what a provider's process may send to one of vehicles: what the
/// interface of the vehicle endpoint takes, and what acceptor and handshake
/// answer.
const message_forms& messages_to_vehicles();

} // namespace sofof::actors
