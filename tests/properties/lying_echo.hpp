// A service whose providers give results that no vehicle can use, now and then.
#pragma once

#include "base/random.hpp"
#include "tests/properties/ledger.hpp"
#include "tests/support/echo_service.hpp"

#include <chrono>
#include <cstdint>
#include <memory>

namespace sofof::test {

/// Lies once in minutes; one result in ten is useless, and now and then all of
/// a fifth of a second are, longer than a gap may be, or all of two seconds.
struct lying_function final : offloading::service_function {
  random_stream draws;
  explicit lying_function(random_stream x) : draws{x} {}

  offloading::service_output
  run(time_point now, const messages::service_input& input) override {
    using namespace std::chrono_literals;
    enum : std::uint32_t { lies, once, for_a_while, for_long };
    const auto since = now.time_since_epoch();
    const auto at = static_cast<std::uint64_t>(since.count());
    const auto part = static_cast<std::uint64_t>(since / 200ms);
    const auto phase = static_cast<std::uint64_t>(since / 2s);
    if (draws.uniform(at, lies) < 0.0005)
      return messages::payload::of(echo{echo::lie});
    if (draws.uniform(at, once) < 0.1 || draws.uniform(part, for_a_while) < 0.01
        || draws.uniform(phase, for_long) < 0.02)
      return messages::payload::of(echo{echo::useless});
    return input.what;
  }
};

struct lying_at_provider final : offloading::provider_service {
  random_stream draws;
  explicit lying_at_provider(random_stream x) : draws{x} {}

  std::shared_ptr<offloading::service_function>
  make_function(station_id) override {
    return std::make_shared<lying_function>(draws);
  }
};

/// @returns the echo of that conduct, made by providers that lie, each when it
/// likes to.
inline conduct with_liars(conduct of, std::uint64_t seed) {
  of.service = [seed, providers = std::uint64_t{0}](
                   const messages::service_name& name) mutable {
    auto lying = echo_service(name);
    const auto draws =
        random_stream{seed, "lies"}.part(name.view()).part(++providers);
    lying.at_provider = [draws](const auto&) {
      return std::make_shared<lying_at_provider>(draws);
    };
    return lying;
  };
  return of;
}

} // namespace sofof::test
