// LODM "always": asks whoever offers.
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

class always final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    const auto& all = context.providers;
    return all.empty() ? as_it_is(name())
                       : local_decision{run_at{all.front().id}, name()};
  }
  std::string_view name() const override { return "always"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<always>(*this);
  }
};

} // namespace

lodm_entry lodm_always() {
  return {{"always", "Asks whoever offers.", "yes", "nothing",
           "ours, to compare with"},
          unfiltered<local_policy, always>};
}

} // namespace sofof::policies
