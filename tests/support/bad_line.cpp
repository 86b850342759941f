// A bad line to a port, for tests/acceptance/distributed.
#include "tests/support/bad_line.hpp"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

std::chrono::microseconds from_ms(const char* text) {
  return std::chrono::microseconds{std::llround(std::atof(text) * 1e3)};
}

} // namespace

/// bad_line PORT DELAY_MS JITTER_MS LOSS: prints the port that leads there.
/// Nothing gets through from a SIGUSR1 to a SIGUSR2; ends with SIGTERM.
int main(int argc, char** argv) try {
  constexpr int arguments = 5;
  if (argc != arguments)
    return 2;
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGUSR1, SIGUSR2, SIGINT, SIGTERM})
    sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  sofof::test::line_faults faults;
  faults.delay = from_ms(argv[2]);
  faults.jitter = from_ms(argv[3]);
  faults.loss = std::atof(argv[4]);
  sofof::test::bad_line line{static_cast<std::uint16_t>(std::atoi(argv[1])),
                             faults, 1};
  std::printf("%d\n", line.port());
  std::fflush(stdout);
  for (int signal = 0; sigwait(&signals, &signal) == 0;) {
    if (signal == SIGUSR1)
      line.interrupt();
    else if (signal == SIGUSR2)
      line.restore();
    else
      return 0;
  }
  return 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bad_line: %s\n", e.what());
  return 1;
}
