// Limits in words.
#include "offloading/qos_monitor.hpp"

#include <fmt/format.h>

#include <cassert>

namespace sofof::offloading {

std::string in_words(std::string_view limit, duration value, duration most) {
  assert(value >= most || value < duration{0});
  return fmt::format("{} value_ms={:.6f} limit_ms={:.6f}", limit,
                     1e3 * to_seconds(value), 1e3 * to_seconds(most));
}

} // namespace sofof::offloading
