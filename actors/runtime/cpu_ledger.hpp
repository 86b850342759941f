// A ledger of computing time: which actors took how much of it, for what.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/service.hpp"

#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sofof::actors {

/// For what an actor works: offloading in a vehicle, or something else.
struct cpu_account {
  std::optional<station_id> station{}; ///< The vehicle that it works for.
  messages::service_name service;      ///< Empty: all of the vehicle's.
  bool remote = false; ///< Whether it (or any of all) is remote meanwhile.

  auto operator<=>(const cpu_account&) const = default;
};

/// What all actors of one name took on one account.
struct cpu_line {
  cpu_account account;
  std::string_view actor;  ///< Their name.
  duration cpu{};          ///< For how long they computed,
  duration time{};         ///< while this much time passed, for each added up,
  std::uint64_t wakes = 0; ///< in so many turns of one or more messages.
};

/// Adds up turns of actors. For any number of threads.
class cpu_ledger {
public:
  /// @param clock  Tells the time of the run; for any thread.
  explicit cpu_ledger(std::function<time_point()> clock)
      : clock_{std::move(clock)} {}

  /// What an actor takes from now on goes to this account. An actor that
  /// nobody has said anything of is on an account of no station.
  void charge(std::uint64_t actor, const cpu_account& to);

  /// An actor has had a turn.
  /// @param name  Lives as long as the process.
  void add_turn(std::uint64_t actor, std::string_view name, duration cpu);

  /// An actor has ended: no more time passes for it.
  void close(std::uint64_t actor);

  /// Forgets what was taken so far.
  void restart();

  /// @returns what was taken up to now, in the order of accounts and names.
  std::vector<cpu_line> lines() const;

private:
  struct sums {
    duration cpu{};
    duration time{};
    std::uint64_t wakes = 0;
  };
  using all_sums = std::map<std::pair<cpu_account, std::string_view>, sums>;

  struct holder { // of an open account
    cpu_account account;
    std::string_view name;
    time_point since; // on this account
    duration cpu{};
    std::uint64_t wakes = 0;
  };

  holder& open(std::uint64_t actor);
  static void settle(const holder& of, time_point until, all_sums& into);

  std::function<time_point()> clock_;
  mutable std::mutex mutex_;
  std::unordered_map<std::uint64_t, holder> holders_;
  all_sums settled_;
};

} // namespace sofof::actors
