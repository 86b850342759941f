// A rule of the protocol that a trace does not keep.
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <string>

namespace sofof::experiments::conformance {

/// Where a step stands: in which of the traces that are read together, and in
/// which line of that.
struct trace_place {
  std::size_t trace = 0;
  std::size_t line = 0;
  friend auto operator<=>(const trace_place&, const trace_place&) = default;
};

struct breach {
  std::string rule; ///< As docs/trace.md has it.
  std::string what; ///< Who broke it, and how.
  trace_place at;   ///< The step that did, or after which it was to be seen.
};

/// Takes breaches up as they are found.
using breach_sink = std::function<void(breach&&)>;

} // namespace sofof::experiments::conformance
