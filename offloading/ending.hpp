// Why a session ends, for records.
#pragma once

#include "messages/protocol/service.hpp"

#include <string>
#include <utility>

namespace sofof::offloading {

/// The reason, and what led to it.
struct ending {
  messages::end_reason reason;
  /// A value and its limit, or whose decision it was; empty where the reason
  /// says it all.
  std::string because;

  ending(messages::end_reason reason, std::string because = {})
      : reason{reason}, because{std::move(because)} {}
};

} // namespace sofof::offloading
