// CODM "always".
#include "policies/api/same_for_all.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

codm_entry codm_always() {
  return {{"always", "Accepts everybody.", "yes", "nothing",
           "ours, to compare with"},
          unfiltered<central_policy, same_for_all<true>>};
}

} // namespace sofof::policies
