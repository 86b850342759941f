// Runs that a worker on another host carries out.
#pragma once

#include "network/network_address.hpp"
#include "scenario/hosts.hpp"
#include "scenario/sweep/run_site.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace sofof {

struct far_site_options : host_options {
  std::vector<network_address> workers;
  std::string program; ///< They must be the same; see `run_store`.
};

/// Connects to workers, and to those that are lost again and again, with
/// growing pauses. Returns when each has answered or could not be reached.
/// @returns one site for each of them.
/// @throws input_error when one refuses us, with its reason; network_error.
std::vector<std::shared_ptr<run_site>>
connect_to_workers(const far_site_options& what);

} // namespace sofof
