// A vehicle that runs its services at two providers.
#pragma once

#include "policies/api/context.hpp"
#include "tests/properties/ledger.hpp"

#include <memory>
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
