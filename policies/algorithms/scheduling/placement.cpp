// Which core takes a further session.
#include "policies/algorithms/scheduling/placement.hpp"

#include "policies/algorithms/scheduling/edf.hpp"
#include "policies/algorithms/scheduling/phases.hpp"

namespace sofof::policies {

namespace {

/// @returns the offset with which a core can take the session; nullopt if it
/// cannot.
std::optional<duration> fitting_offset(std::span<const periodic_task> running,
                                       const periodic_task& session,
                                       admission_test test) {
  if (test == admission_test::phases)
    return assigned_offset(running, session);
  std::vector<periodic_task> tasks{running.begin(), running.end()};
  tasks.push_back(session);
  const auto fits = test == admission_test::demand ? fits_by_demand(tasks)
                                                   : fits_by_utilisation(tasks);
  return fits ? std::optional{duration{0}} : std::nullopt;
}

} // namespace

std::optional<core_place>
worst_fit(std::span<const std::vector<periodic_task>> cores,
          const periodic_task& session, admission_test test) {
  std::optional<core_place> best;
  double least = 0;
  for (std::size_t core = 0; core < cores.size(); ++core) {
    const auto used = utilisation(cores[core]);
    if (best && used >= least)
      continue;
    const auto offset = fitting_offset(cores[core], session, test);
    if (!offset)
      continue;
    best = core_place{core, *offset};
    least = used;
  }
  return best;
}

} // namespace sofof::policies
