// A rule of the protocol that a trace does not keep.
#pragma once

#include "experiments/conformance/rules.hpp"

#include <fmt/format.h>

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
  rule broken;
  std::string what; ///< Which part broke it, and how.
  trace_place at;   ///< The step that did, or after which it was to be seen.
};

/// @returns the rule and how it was broken.
inline std::string in_words(const breach& x) {
  return fmt::format("{} {}: {}", x.broken.id, x.broken.sentence, x.what);
}

/// Takes breaches up as they are found.
using breach_sink = std::function<void(breach&&)>;

} // namespace sofof::experiments::conformance
