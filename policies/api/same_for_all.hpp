// A CODM that needs no thought; what others are compared with.
#pragma once

#include "policies/api/context.hpp"

#include <memory>
#include <type_traits>
#include <vector>

namespace sofof::policies {

/// Says the same to every request: "always" or "never".
template <bool yes>
class same_for_all final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    using verdict = std::conditional_t<yes, accepted, refused>;
    return std::vector<central_decision>(context.requests.size(),
                                         {verdict{}, name()});
  }
  std::string_view name() const override { return yes ? "always" : "never"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<same_for_all>(*this);
  }
};

} // namespace sofof::policies
