// Governor "predictive_gate": offloads only where results will be in time.
#pragma once

#include "policies/algorithms/forecast/predictive_gate.hpp"
#include "policies/governors/governor.hpp"

#include <map>
#include <string>
#include <utility>

namespace sofof {

/// A gate for each service and provider on the forecast that its next result is
/// late. A provider whose gate is closed is not asked, and a service that runs
/// there comes home, unless it has just begun and there is no forecast yet.
class predictive_gate_governor final : public governor {
public:
  local_decision govern(const local_context& context,
                        const local_decision& wanted) override;
  double epoch_s() const override { return epoch_s_; }
  void visit_options(option_visitor& s) override;
  std::string_view name() const override { return "predictive_gate"; }
  std::unique_ptr<governor> clone() const override {
    return std::make_unique<predictive_gate_governor>(*this);
  }

private:
  bool open(const local_context& context, const provider_view& provider);

  double on_ = 0.005;
  double off_ = 0.02;
  double epoch_s_ = 0.1;
  std::map<std::pair<std::string, provider_id>, predictive_gate> gates_;
};

} // namespace sofof
