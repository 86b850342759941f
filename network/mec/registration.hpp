// Keeps a provider in a registry.
#pragma once

#include "base/random.hpp"
#include "base/time.hpp"
#include "network/flow/exponential_backoff.hpp"
#include "network/mec/registry.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace sofof::network::mec011 {

/// One provider's entry: added, looked after, added again when the registry has
/// lost it, INACTIVE in the end. Waits for nothing but for the registry's
/// answers; whoever calls `step` waits in between.
class registration {
public:
  /// @param application  Plain name: the platform knows us by it.
  /// @param own    What is told of the provider; its id is not used.
  /// @param draws  For pauses.
  /// @param publish  Called once for each change.
  registration(registry at, std::string application, service_info own,
               random_stream draws,
               std::function<void(const registry_news&)> publish);

  /// Does what is due.
  /// @returns how long to wait before the next step.
  duration step();

  /// The provider is about to leave: one attempt to tell.
  void end();

private:
  void keep();
  void add();
  void publish(const registry_news& news);
  std::string name() const;

  const registry at_;
  const std::string application_;
  service_info own_; ///< With an id while it is registered.
  const random_stream draws_;
  const std::function<void(const registry_news&)> publish_;
  bool is_confirmed_ = false;
  std::uint64_t steps_ = 0;
  exponential_backoff pauses_;
  std::string last_told_;
};

} // namespace sofof::network::mec011
