// CODM "process": a program of any language decides.
#include "policies/entry.hpp"
#include "policies/process_policy.hpp"

#include <vector>

namespace sofof::policies {

namespace {

using central_process =
    process_policy<central_context, std::vector<central_decision>,
                   request_view>;

} // namespace

codm_entry codm_process() {
  return {{"process", "Asks another program, a line of JSON each way.",
           "what the program answers", "all that a policy sees, but the map",
           "docs/policy_process.md", process_notes()},
          filtered_by_request<central_process>};
}

} // namespace sofof::policies
