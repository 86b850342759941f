// How actors say for whom they work, in case somebody keeps accounts.
#include "actors/runtime/cpu_accounts.hpp"

#include "actors/runtime/accounting_scheduler.hpp"

namespace sofof::actors {

cpu_ledger* ledger_of(caf::actor_system& sys) {
  auto* scheduler = dynamic_cast<accounting_scheduler*>(&sys.scheduler());
  return scheduler ? &scheduler->data().ledger : nullptr;
}

void charge(caf::actor_system& sys, caf::actor_id who, const cpu_account& to) {
  if (auto* ledger = ledger_of(sys))
    ledger->charge(who, to);
}

} // namespace sofof::actors
