// Policies of providers that look at how, and what, they are asked.
#pragma once

#include "base/candidate.hpp"
#include "base/time.hpp"
#include "policies/api/context.hpp"
#include "policies/registry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

namespace sofof::test {

/// Decides about requests of a fifth of a second together, once in it.
class patient final : public policies::central_policy {
public:
  std::vector<policies::central_decision>
  decide(const policies::central_context& context) override {
    CHECK(context.now - last_ >= from_seconds(epoch_s()));
    last_ = context.now;
    return inner_->decide(context);
  }
  double epoch_s() const override { return 0.2; }
  std::string_view name() const override { return "patient"; }
  std::unique_ptr<policies::central_policy> clone() const override {
    return std::make_unique<patient>();
  }

private:
  time_point last_{}; // decision
  std::unique_ptr<policies::central_policy> inner_ =
      policies::make_codm("location");
};

/// Counts of whom else than of this provider its vehicles tell.
class attentive final : public policies::central_policy {
public:
  /// @param others  Outlives it.
  explicit attentive(int& others) : others_{others} {}

  std::vector<policies::central_decision>
  decide(const policies::central_context& context) override {
    for (const auto& x : context.requests) {
      CHECK(std::ranges::count(x.candidates, context.self, &candidate::provider)
            == 1);
      others_ += static_cast<int>(x.candidates.size()) - 1;
    }
    return inner_->decide(context);
  }
  std::string_view name() const override { return "attentive"; }
  std::unique_ptr<policies::central_policy> clone() const override {
    return std::make_unique<attentive>(others_);
  }

private:
  int& others_;
  std::unique_ptr<policies::central_policy> inner_ =
      policies::make_codm("location");
};

} // namespace sofof::test
