// Governor "hysteresis": no hasty changes of where a service runs.
#pragma once

#include "policies/governors/governor.hpp"
#include "policies/governors/hysteresis.hpp"

#include <map>
#include <string>

namespace sofof {

/// Lets a service go to a provider only when that was wanted for a while, and
/// not soon after it came home or somewhere else. What comes home is never
/// kept.
class hysteresis_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  void visit_options(option_visitor& s) override;
  double epoch_s() const override { return epoch_s_; }
  std::string_view name() const override { return "hysteresis"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<hysteresis_governor>(*this);
  }

private:
  hysteresis_options options_;
  double epoch_s_ = 0.1;
  std::map<std::string, hysteresis, std::less<>> services_;
};

} // namespace sofof
