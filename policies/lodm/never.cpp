// LODM "never": plans on board, whatever is offered.
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

class never final : public local_policy {
public:
  local_decision decide(const local_context&) override {
    return as_it_is(name());
  }
  std::string_view name() const override { return "never"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<never>(*this);
  }
};

} // namespace

lodm_entry lodm_never() {
  return {{"never", "Plans on board, whatever is offered.", "no", "nothing",
           "ours, to compare with"},
          unfiltered<local_policy, never>};
}

} // namespace sofof::policies
