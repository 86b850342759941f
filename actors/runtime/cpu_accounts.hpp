// How actors say for whom they work, in case somebody keeps accounts.
#pragma once

#include "actors/runtime/cpu_ledger.hpp"

#include <caf/fwd.hpp>

namespace sofof::actors {

/// @returns the ledger of a system with an accounting scheduler; else null.
cpu_ledger* ledger_of(caf::actor_system& sys);

/// What `who` takes from now on goes to this account, if there is a ledger. For
/// turning points, not for every message.
void charge(caf::actor_system& sys, caf::actor_id who, const cpu_account& to);

} // namespace sofof::actors
