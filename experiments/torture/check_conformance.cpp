// Holds a run's steps of the protocol against its rules.
#include "experiments/conformance/trace_file.hpp"
#include "experiments/torture/promises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace sofof::experiments::torture {

void check_conformance(const finished_run& run, broken_promises& to) {
  constexpr std::size_t most = 3;
  conformance::trace_checker steps{conformance::slack_of(run.folder),
                                   conformance::chain_of_services()};
  conformance::read_trace(run.folder, 0, steps);
  const auto& breaches = steps.finish();
  for (std::size_t k = 0; k < std::min(breaches.size(), most); ++k)
    to.push_back(
        {"conformance", fmt::format("line {}: {}", breaches[k].at.line,
                                    conformance::in_words(breaches[k]))});
}

} // namespace sofof::experiments::torture
