// LODM "location": the paper's.
#include "policies/filters/location.hpp"

#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Asks the first provider that is near enough; goes on to the next one when
/// the way leaves the one where the service runs.
class location final : public local_policy {
public:
  local_decision decide(const local_context& context) override {
    reason first; // objection
    for (const auto& provider : context.providers) {
      const auto why = objection(context, provider);
      if (why.empty())
        return {run_at{provider.id}, "d_passed > d_min"};
      if (first.empty())
        first = why;
    }
    return as_it_is(first.empty() ? "nobody offers it" : first);
  }
  reason objection(const local_context& context,
                   const provider_view& provider) const override {
    return near_.objection(context, provider);
  }
  /// Where the way leaves it soon, the provider will end it.
  bool foresees_home(const local_context& context) const override {
    const auto* here = where_it_runs(context);
    return here && !objection(context, *here).empty();
  }
  void visit_options(option_visitor& s) override { near_.visit_options(s); }
  std::string_view name() const override { return "location"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<location>(*this);
  }

private:
  near_provider near_;
};

} // namespace

lodm_entry lodm_location() {
  return {{"location",
           "Asks as soon as the way ahead stays long enough near a provider.",
           "d_passed > d_min, the way on the planned path before it leaves the "
           "disc of radius r_off round the provider",
           "the planned path, where providers are",
           "Dehler & Buchholz, IEEE RA-L 10(5), 2025",
           near_provider::parameters()},
          unfiltered<local_policy, location>};
}

} // namespace sofof::policies
