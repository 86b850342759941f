// The actors that offloading parts know by number.
#pragma once

#include "offloading/peer.hpp"

#include <caf/actor_addr.hpp>

#include <cstdint>
#include <map>
#include <optional>

namespace sofof::actors {

/// Handles of one kind by number, and numbers by address.
template <class Handle>
class peers {
public:
  std::optional<offloading::peer_id> find(const caf::actor_addr& who) const {
    const auto i = numbers_.find(who);
    if (i == numbers_.end())
      return std::nullopt;
    return i->second;
  }

  /// @returns the number of a new one.
  offloading::peer_id add(const Handle& who) {
    const offloading::peer_id number{++last_};
    numbers_.emplace(who.address(), number);
    handles_.emplace(number, who);
    return number;
  }

  /// @throws std::out_of_range for a number that has been forgotten.
  const Handle& at(offloading::peer_id number) const {
    return handles_.at(number);
  }

  void forget(offloading::peer_id number) {
    if (const auto handle = handles_.extract(number); !handle.empty())
      numbers_.erase(handle.mapped().address());
  }

private:
  std::map<caf::actor_addr, offloading::peer_id> numbers_; // never gone through
  std::map<offloading::peer_id, Handle> handles_;
  std::uint64_t last_ = 0;
};

} // namespace sofof::actors
