// Finds how many vehicles a running provider carries.
#pragma once

#include "base/time.hpp"
#include "experiments/load_test/served_step.hpp"
#include "network/network_address.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace sofof::experiments::load_test {

struct load_options {
  std::filesystem::path scenario;
  std::vector<std::string> changes; ///< By `--set`, but for vehicles.
  std::string provider; ///< Its name in the scenario; empty: the only one.
  network::network_address at;
  std::string keys; ///< See `scenario::host_options`.
  /// How many vehicles are tried, ascending; empty: searched from 10 on.
  std::vector<std::int64_t> vehicles;
  std::int64_t most = 0;                        ///< Of a search; > 0.
  duration measured = std::chrono::seconds{10}; ///< In each step.
  duration within = std::chrono::milliseconds{20};
  std::filesystem::path out; ///< Results of the steps; empty: not kept.
  std::string version;
};

/// @returns whether a provider carries so many: 99 of 100 results that are due
/// come, and 99 of 100 are made within this time after they were due.
bool is_carried(const served_step& step, duration within);

/// Plays vehicles of a scenario, first few, then more, each of which wants all
/// that the provider offers and follows its lane on board; prints a line a
/// step, and how many are carried.
/// @returns whether the steps could be made; not if it was interrupted.
/// @throws input_error.
bool test_load(const load_options& options,
               const std::atomic<bool>& interrupted, std::ostream& screen);

} // namespace sofof::experiments::load_test
