// Admission by what a provider's workers can carry.
#pragma once

#include "policies/context.hpp"

namespace sofof {

/// CODM "capacity": accepts as long as all services together need no more than
/// a given share of the workers; of requests that come together, first come,
/// first served. With Poisson-like arrivals at one worker of service time S,
/// the mean wait is ρ S / (2 (1 − ρ)) (M/D/1: Pollaczek and Khinchine), so
/// that a budget w for it means a share of 2 w / (S + 2 w).
class capacity_codm final : public central_policy {
public:
  std::vector<central_decision> decide(const central_context& context) override;
  void fields(settings& s) override;
  std::string_view name() const override { return "capacity"; }
  std::unique_ptr<central_policy> clone() const override;

private:
  double most_ = 0.8; // utilisation, all services together
};

} // namespace sofof
