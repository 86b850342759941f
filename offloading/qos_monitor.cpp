// Limits in words.
#include "offloading/qos_monitor.hpp"

#include <fmt/format.h>

#include <cassert>

namespace sofof::offloading {

std::string in_words(std::string_view name, duration value, duration limit) {
  assert(!name.empty());
  return fmt::format("{} value_ms={:.6f} limit_ms={:.6f}", name,
                     1e3 * to_seconds(value), 1e3 * to_seconds(limit));
}

} // namespace sofof::offloading
