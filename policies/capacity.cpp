// Admission by what a provider's workers can carry.
#include "policies/capacity.hpp"

namespace sofof {

std::vector<central_decision>
capacity_codm::decide(const central_context& context) {
  std::vector<central_decision> all;
  auto used = context.utilisation;
  for (const auto& request : context.requests) {
    const auto fits = used + request.utilisation <= most_;
    if (fits)
      used += request.utilisation;
    all.push_back({fits, fits ? "there is room" : "no room"});
  }
  return all;
}

void capacity_codm::fields(settings& s) {
  s.field("most", most_, {0, 1e3});
}

std::unique_ptr<central_policy> capacity_codm::clone() const {
  return std::make_unique<capacity_codm>(*this);
}

} // namespace sofof
