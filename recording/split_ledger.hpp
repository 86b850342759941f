// What was done for each service in each split of its chain, vehicle by
// vehicle: times, octets and results as they were recorded.
#pragma once

#include "messages/protocol/record.hpp"
#include "recording/run_info.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::recording {

/// Where each service of a chain runs, in their order: at the provider of this
/// name, or, empty, in the vehicle.
using split = std::vector<std::string>;

/// What was done for one service of a vehicle.
struct service_use {
  std::uint64_t computed = 0; ///< Results of the vehicle's own function,
  duration computing{};       ///< and what it computed for them.
  std::uint64_t octets_up = 0, octets_down = 0; ///< On the air.
  std::uint64_t results = 0;                    ///< Of providers, used or not.
  std::map<std::string, duration> served; ///< Computed there, by provider.

  service_use& operator+=(const service_use& x);
};

/// A chain of a vehicle while it was split in one way.
struct split_use {
  duration driven{};
  double distance_m = 0;
  std::vector<service_use> services; ///< In the order of the chain.
};

/// Whose chain, and which: its place in `energy_terms::chains`.
struct chain_user {
  station_id station = 0;
  std::size_t chain = 0;
  friend auto operator<=>(const chain_user&, const chain_user&) = default;
};

/// Puts what vehicles tell where it belongs. A record that covers some time is
/// shared among the splits of that time, by how long each lasted; parts add up
/// to what was told, exactly. A service that several providers run counts as at
/// the one that was chosen last.
class split_ledger {
public:
  explicit split_ledger(const run_info& run);

  void add(const messages::event_record& x);
  void add(const messages::work_record& x);
  void add(const messages::cycle_record& x);
  void add(const messages::safety_record& x);
  void add(const messages::drive_record& x);
  template <class Other>
  void add(const Other&) {}

  const std::map<chain_user, std::map<split, split_use>>& uses() const {
    return uses_;
  }

private:
  /// From its begin to that of the next one.
  struct stretch {
    time_point from;
    split where;
  };
  struct place {
    std::size_t chain, service;
  };
  struct window {
    time_point from, until;
  };
  struct part {
    split_use* of;
    duration time; ///< Of those of all parts together, which is > 0.
  };

  std::vector<stretch>& stretches_of(const chain_user& who);
  split_use& use_of(const chain_user& who, const split& where);
  std::vector<part> parts_of(const chain_user& who, const window& when);

  time_point start_;
  provider_names names_;
  std::vector<std::size_t> lengths_; // of the chains
  std::map<std::string, place, std::less<>> places_;
  std::map<chain_user, std::vector<stretch>> stretches_; // the latest, in order
  std::map<chain_user, std::map<split, split_use>> uses_;
  std::map<station_id, window> driven_; // what was told last
};

} // namespace sofof::recording
