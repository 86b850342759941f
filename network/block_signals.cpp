// Manners of threads, by the system's calls.
#include "network/block_signals.hpp"

#include <csignal>
#include <initializer_list>

namespace sofof::network {

void leave_signals_to_others() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const auto signal : {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

} // namespace sofof::network
