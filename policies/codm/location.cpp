// CODM "location": the paper's.
#include "policies/filters/location.hpp"

#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Accepts every vehicle that stays long enough.
class location_codm final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    std::vector<central_decision> all;
    for (const auto& request : context.requests) {
      const auto why = objection(context, request);
      all.push_back(why.empty()
                        ? central_decision{accepted{}, "t_in_area >= t_min"}
                        : central_decision{refused{}, why});
    }
    return all;
  }
  reason objection(const central_context& context,
                   const request_view& request) const override {
    return stays_.objection(context, request);
  }
  void visit_options(option_visitor& s) override { stays_.visit_options(s); }
  std::string_view name() const override { return "location"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<location_codm>(*this);
  }

private:
  stays_in_area stays_;
};

} // namespace

codm_entry codm_location() {
  return {
      {"location", "Accepts vehicles that will stay long enough in the area.",
       "the route is on the map; and t_in_area >= t_min, the way on the route "
       "before it leaves the area by the present speed",
       "the route and the speed that requests tell, a map",
       "Dehler & Buchholz, IEEE RA-L 10(5), 2025", stays_in_area::parameters()},
      unfiltered<central_policy, location_codm>};
}

} // namespace sofof::policies
