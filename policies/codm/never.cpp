// CODM "never".
#include "policies/entry.hpp"
#include "policies/same_for_all.hpp"

namespace sofof {

codm_entry codm_never() {
  return {
      {"never", "Accepts nobody.", "no", "nothing", "ours, to compare with"},
      alone<central_policy, same_for_all<false>>};
}

} // namespace sofof
