// The two decisions that need no thought; what others are compared with.
#pragma once

#include "policies/context.hpp"

namespace sofof {

/// LODM that asks whoever offers, or nobody: "always" or "never".
class constant_lodm final : public local_policy {
public:
  explicit constant_lodm(bool yes) : yes_{yes} {}
  local_decision decide(const local_context& context) override {
    const auto asks = yes_ && !context.providers.empty();
    return {asks ? context.providers.front().id : boot_id{0}, name()};
  }
  std::string_view name() const override { return yes_ ? "always" : "never"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<constant_lodm>(*this);
  }

private:
  bool yes_;
};

/// CODM that says the same to every request: "always" or "never".
class constant_codm final : public central_policy {
public:
  explicit constant_codm(bool yes) : yes_{yes} {}
  std::vector<central_decision>
  decide(const central_context& context) override {
    return std::vector<central_decision>(context.requests.size(),
                                         {yes_, name()});
  }
  std::string_view name() const override { return yes_ ? "always" : "never"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<constant_codm>(*this);
  }

private:
  bool yes_;
};

} // namespace sofof
