// Where a registry says that providers are.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"
#include "network/flow/exponential_backoff.hpp"
#include "network/mec/registry.hpp"
#include "network/mec/repeating_thread.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sofof::network::mec011 {

/// Which entries of a registry vehicles go by.
struct directory_rules {
  std::set<std::string> providers; ///< Those of the scenario; no others.
  std::string version;             ///< Of the protocol.
  /// Whether connections are by TLS, to anywhere; else they lead to this
  /// machine alone.
  bool is_secured = true;
};

/// Where a provider is tried next.
struct next_attempt {
  std::optional<network_address> at; ///< None: it is not listed as ACTIVE.
  /// Whether the registry had better be asked anew, soon: for some answers from
  /// the moment on in which a connection is missed, or its entry has changed.
  bool is_urgent = false;
};

/// Remembers the last good answer of a registry, whatever comes later. `step`
/// is called by one thread, the others by any.
class directory {
public:
  /// @param draws  For pauses.
  /// @param publish  Called once for each change, by who calls `step`.
  directory(registry at, directory_rules rules, random_stream draws,
            std::function<void(const registry_news&)> publish);

  /// Asks. @returns the pause before the next time.
  pause_between step();

  /// Waits for the first answer if there is none yet.
  /// @param patience  For how long.
  void await_first(std::chrono::milliseconds patience);

  /// For who has no connection. All addresses of a provider have their turn.
  next_attempt next(const std::string& provider);

  /// @returns the address that `next` gave last, or where one is asked for.
  std::string place_of(const std::string& provider) const;

private:
  using addresses = std::vector<network_address>;
  using address_book = std::map<std::string, addresses>;

  static addresses places_in(const address_book& book,
                             const std::string& provider);
  address_book read(const service_list& from, std::string& left_out) const;
  std::string why_not(const service_info& entry) const;
  std::string why_not(const network_address& at) const;
  std::string describe(const address_book& all) const;
  void publish(const registry_news& news);

  const registry at_;
  const directory_rules rules_;
  const random_stream draws_;
  const std::function<void(const registry_news&)> publish_;
  // Of who calls `step`:
  exponential_backoff pauses_;
  std::string last_told_;

  struct attempts {
    std::size_t turn = 0;
    network_address last;
    std::uint64_t missed_from = 0; ///< In steps.
    std::uint64_t missed_at = 0;   ///< Lately.
  };

  mutable std::mutex mutex_; // guards
  std::condition_variable answered_;
  std::uint64_t steps_ = 0;
  address_book book_;
  std::map<std::string, attempts> attempts_; // of those that are missed
};

} // namespace sofof::network::mec011
