// Whether a result that another computer has sent may be used.
#pragma once

#include "base/objection.hpp"
#include "messages/protocol/service.hpp"

#include <memory>
#include <optional>
#include <span>

namespace sofof::offloading {

/// What a result that came over the air is to the vehicle.
struct judged_result {
  messages::payload what; ///< Empty: it is not used.
  /// Present: it is implausible, and its provider is not believed any more.
  std::optional<objection> refused{};
  /// Present: why it is of no use. A provider that sends nothing better in time
  /// is not believed any more either.
  std::optional<objection> useless{};
  /// How far one that is used stays within limits; until the next call.
  std::span<const margin> margins{};
};

/// Reads the results of one session in a vehicle and judges each before it is
/// used. Pure: the same results at the same times are judged alike.
class result_judge {
public:
  virtual ~result_judge() = default;

  /// @param result  As it came.
  /// @param latest  The vehicle's newest input, of no session; `in_use` is the
  ///                result in use.
  /// @param now     When the result came.
  virtual judged_result judge(const messages::payload& result,
                              const messages::service_input& latest,
                              time_point now) = 0;
};

/// @returns a judge that uses results as they are.
inline std::unique_ptr<result_judge> believe_all() {
  struct believer final : result_judge {
    judged_result judge(const messages::payload& result,
                        const messages::service_input&, time_point) override {
      return {result};
    }
  };
  return std::make_unique<believer>();
}

} // namespace sofof::offloading
