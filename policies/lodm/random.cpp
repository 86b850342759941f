// LODM "random": asks by the toss of a coin.
#include "policies/api/drawn_place.hpp"
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Asks any provider, with a given probability.
class random_choice final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    const auto& all = context.providers;
    if (context.current)
      return as_it_is("it runs already");
    if (all.empty())
      return as_it_is("nobody comes into question");
    constexpr std::uint32_t whether = 0, whom = 1;
    if (context.noise.uniform(context.number, whether) > probability_)
      return as_it_is("drawn: no");
    const auto& drawn = all[drawn_place(context, whom, all.size())];
    return {run_at{drawn.id}, "drawn: yes"};
  }
  void visit_options(option_visitor& s) override {
    s.field("probability", probability_, {0, 1});
  }
  std::string_view name() const override { return "random"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<random_choice>(*this);
  }

private:
  double probability_ = 0.5; // of asking anybody
};

} // namespace

lodm_entry lodm_random() {
  return {{"random",
           "Asks by the toss of a coin.",
           "U < probability; then any provider",
           "nothing",
           "ours, to compare with",
           {{"probability", "1", "of asking anybody"}}},
          filtered_by_provider<random_choice>};
}

} // namespace sofof::policies
