// What every decision policy has in common.
#pragma once

#include "world/ids.hpp"
#include "world/settings.hpp"
#include "world/time.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace sofof {

/// What one cycle of a running service was like.
struct cycle_outcome {
  std::string_view kind; ///< Of the service.
  boot_id provider = 0;
  double latency_s = 0;
  bool missed = false; ///< Later than the limit, so not used.
};

/// What one whole offloading was like.
struct episode_outcome {
  std::string_view kind; ///< Of the service.
  boot_id provider = 0;
  double remote_s = 0;         ///< Time on the remote source.
  std::string_view end_reason; ///< One of protocol's reasons.
};

/// Decides from a context and nothing else: the same context (and learned
/// state) gives the same decision. Time and randomness come in the context.
template <class Context, class Decision>
class policy {
public:
  virtual ~policy() = default;

  virtual Decision decide(const Context& context) = 0;

  /// Feedback: one planning cycle.
  virtual void observe(const cycle_outcome&) {}
  /// Feedback: one offloading, when it has ended.
  virtual void observe(const episode_outcome&) {}

  /// Lists the options once (world/settings.hpp).
  virtual void fields(settings&) {}

  virtual std::string_view name() const = 0;

  /// @returns a policy with the same options and learned state; every
  /// vehicle and provider has one of its own.
  virtual std::unique_ptr<policy> clone() const = 0;
};

} // namespace sofof
