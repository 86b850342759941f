// What a thread owes the others of its process.
#pragma once

namespace sofof::network {

/// Signals go to other threads, and a write to a closed connection is an error
/// and no signal: to be called first by each thread that has sockets.
void leave_signals_to_others();

} // namespace sofof::network
