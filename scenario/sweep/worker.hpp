// A process that carries out runs for sweeps on other hosts.
#pragma once

#include "network/network_address.hpp"
#include "scenario/hosts.hpp"
#include "scenario/sweep/crew.hpp"

#include <atomic>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace sofof {

struct worker_options : host_options {
  network_address listen;
  std::uint32_t slots = 1; ///< Runs at a time.
  std::string program; ///< Only the same one is worked for; see `run_store`.
  order_runner run;
};

/// Carries out orders until it is interrupted; whoever ordered one gets the
/// files of its results. Nothing is kept.
/// @param console  Is told where it listens, and who was refused, once a second
///                 at most.
/// @throws input_error, network_error when it cannot listen.
void worker(const worker_options& what, const std::atomic<bool>& interrupted,
            std::ostream& console);

} // namespace sofof
