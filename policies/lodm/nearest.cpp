// LODM "nearest": asks the provider nearest to where the vehicle is now.
#include "policies/entry.hpp"

#include <algorithm>

namespace sofof::policies {

namespace {

class nearest final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    if (context.providers.empty() || context.path.empty())
      return as_it_is("nobody comes into question");
    const auto here = context.path.front();
    const auto best =
        std::ranges::min_element(context.providers, {}, [here](const auto& p) {
          return distance_m(p.at, here);
        });
    return {run_at{best->id}, "the nearest"};
  }
  std::string_view name() const override { return "nearest"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<nearest>(*this);
  }
};

} // namespace

lodm_entry lodm_nearest() {
  return {{"nearest", "Asks the nearest provider.", "min |x_provider - x|",
           "where providers are", "ours, to compare with"},
          filtered_by_provider<nearest>};
}

} // namespace sofof::policies
