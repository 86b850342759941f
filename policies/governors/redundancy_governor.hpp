// Governor "redundancy": two providers plan the same cycles.
#pragma once

#include "policies/governors/governor.hpp"

namespace sofof {

/// Where a service runs at one provider, or shall, has another one run it too:
/// of those that come into question the one that is late least often. Of each
/// cycle the first result is used.
/// Source: Dean & Barroso, The Tail at Scale, CACM 56(2), 2013.
class redundancy_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "redundancy"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<redundancy_governor>(*this);
  }

private:
  double least_late_ = 0;  // below this one provider is enough
  duration hedge_after_{}; // 0: the other one plans every cycle
};

} // namespace sofof
