// LODM "process": a program of any language decides.
#include "policies/entry.hpp"
#include "policies/process_policy.hpp"

namespace sofof::policies {

namespace {

using local_process =
    process_policy<local_context, local_decision, provider_view>;

} // namespace

lodm_entry lodm_process() {
  return {{"process", "Asks another program, a line of JSON each way.",
           "what the program answers", "all that a policy sees, but the future",
           "docs/policy_process.md", process_notes()},
          filtered_by_provider<local_process>};
}

} // namespace sofof::policies
