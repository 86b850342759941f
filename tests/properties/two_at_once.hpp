// A vehicle that runs its services at two providers.
#pragma once

#include "policies/api/context.hpp"
#include "tests/properties/ledger.hpp"
#include "tests/support/option_list.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string_view>

namespace sofof::test {

/// Runs every service at the first two providers that there are. The second
/// one stands by if `hedge_after` is not 0.
class two_at_once final : public policies::local_policy {
public:
  explicit two_at_once(duration hedge_after) : hedge_after_{hedge_after} {}

  policies::local_decision decide(const policies::local_context& c) override {
    policies::run_at there{c.current.value_or(c.providers.front().id)};
    for (const auto& x : c.providers)
      if (x.id != there.provider && !there.second)
        there.second = {x.id, hedge_after_};
    return {there, "as long as it goes"};
  }
  std::string_view name() const override { return "two_at_once"; }
  std::unique_ptr<policies::local_policy> clone() const override {
    return std::make_unique<two_at_once>(*this);
  }

private:
  duration hedge_after_;
};

inline conduct with_two(duration hedge_after) {
  conduct of;
  of.policy = [hedge_after] {
    return std::make_unique<two_at_once>(hedge_after);
  };
  return of;
}

/// A scene that is safe under every response time, and for ten seconds of each
/// twenty under hardly any.
struct tight_now_and_then {
  static constexpr std::chrono::seconds half{10};

  static bool is_tight(time_point now) {
    return now.time_since_epoch() / half % 2 == 1;
  }
};

/// Its services run at a provider only while its scene is safe under the
/// response time.
inline conduct within_its_scene() {
  using namespace std::chrono_literals;
  struct echo_with_scene final : echo_in_vehicle {
    std::optional<offloading::safe_response>
    look_at_scene(const messages::service_input& latest) const override {
      const auto is_tight = tight_now_and_then::is_tight(latest.at);
      return offloading::safe_response{is_tight ? 100ms : duration{10s},
                                       "a clock"};
    }
  };
  conduct of;
  of.policy = [] {
    option_list options{
        {.texts = {{"govern.0.name", "rss"}}, .lengths = {{"govern", 1}}}};
    auto lodm = policies::make_lodm("always");
    lodm->visit_options(options);
    return lodm;
  };
  of.service = [](const messages::service_name& name) {
    auto made = echo_service(name);
    made.options.limits.max_input_age = 500ms;
    made.in_vehicle = [](const auto&) {
      return std::make_shared<echo_with_scene>();
    };
    return made;
  };
  return of;
}

/// The vehicle's own functions run along for two seconds round a change.
inline conduct warm(conduct of = {}) {
  of.service = [make = of.service](const messages::service_name& name) {
    auto made = make(name);
    made.options.warm_standby = 2s;
    return made;
  };
  return of;
}

/// Its services are computed once for each input.
inline conduct per_input(conduct of = {}) {
  of.service = [](const messages::service_name& name) {
    auto made = echo_service(name);
    made.options.per_input = true;
    return made;
  };
  return of;
}

} // namespace sofof::test
