// A scenario on several hosts: providers here, vehicles there.
#pragma once

#include "actors/time.hpp"
#include "messages/remote.hpp"
#include "scenario/run.hpp"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace sofof {

/// A place on the network.
struct host_port {
  std::string host;
  std::uint16_t port = 0;

  /// @returns whether it is on this machine, by its name.
  bool is_loopback() const;
};

/// @param text  HOST:PORT, or [IPv6]:PORT.
/// @throws input_error.
host_port to_host_port(std::string_view text);

/// What both sides have in common.
struct host_options {
  std::string keys;  ///< Folder with certificate and key; empty on loopback.
  clock_error clock; ///< For tests: how far the own clock is off, ...
  std::uint32_t protocol = remote_protocol; ///< ... and what it speaks.
};

struct provide_options : host_options {
  std::string name; ///< Of the provider; empty: the only one.
  host_port listen;
};

struct drive_options : host_options {
  struct provider {
    std::string name; ///< Empty: the only one.
    host_port at;
  };
  std::vector<provider> providers;
  std::set<station_id> stations; ///< Empty: all.
};

/// Runs one provider, for vehicles of other processes.
/// @throws input_error.
run_outcome provide(const scenario& s, const provide_options& what,
                    run_options options, const std::atomic<bool>& interrupted,
                    std::ostream& console);

/// Runs vehicles, which providers of other processes plan for.
/// @throws input_error, also when a provider refuses us at the beginning.
run_outcome drive(const scenario& s, const drive_options& what,
                  run_options options, const std::atomic<bool>& interrupted,
                  std::ostream& console);

} // namespace sofof
