// CODM "never".
#include "policies/api/same_for_all.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

codm_entry codm_never() {
  return {
      {"never", "Accepts nobody.", "no", "nothing", "ours, to compare with"},
      unfiltered<central_policy, same_for_all<false>>};
}

} // namespace sofof::policies
