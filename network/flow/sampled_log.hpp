// What may happen at any rate, and is logged now and then.
#pragma once

#include "base/time.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::network {

/// Counts all that happens, and logs one of it a period at most.
class sampled_log {
public:
  explicit sampled_log(duration period) : period_{period} {}

  /// Something has happened.
  /// @param what  A sentence without its full stop.
  /// @returns a line for the log: what happened, and how often it has so far;
  /// nothing within a period of the line before.
  std::optional<std::string> add(std::string_view what, time_point now) {
    ++count_;
    if (now < next_)
      return std::nullopt;
    next_ = now + period_;
    return fmt::format("{}; {} so far", what, count_);
  }

private:
  duration period_;
  std::uint64_t count_ = 0;
  time_point next_{};
};

} // namespace sofof::network
