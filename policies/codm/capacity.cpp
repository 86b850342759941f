// CODM "capacity": admission by what a provider's workers can carry.
#include "policies/entry.hpp"

namespace sofof::policies {

namespace {

/// Accepts as long as all services together need no more than a given share of
/// the workers; of requests that come together, first come, first served.
class capacity final : public central_policy {
public:
  std::vector<central_decision>
  decide(const central_context& context) override {
    std::vector<central_decision> all;
    auto used = context.utilisation;
    for (const auto& request : context.requests) {
      const auto asked = used + request.utilisation;
      const auto fits = asked <= most_;
      if (fits)
        used = asked;
      all.push_back(
          fits ? central_decision{accepted{}, "there is room"}
               : central_decision{refused{}, {"no room", asked, most_}});
    }
    return all;
  }
  void visit_options(option_visitor& s) override {
    s.field("most", most_, {0, 1e3});
  }
  std::string_view name() const override { return "capacity"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<capacity>(*this);
  }

private:
  double most_ = 0.8; // utilisation, all services together
};

} // namespace

codm_entry codm_capacity() {
  return {{"capacity",
           "Accepts as long as the workers have room.",
           "U + u <= most; u = mean computing time / (period workers). A mean "
           "wait w asks for most = 2 w / (S + 2 w) (M/D/1, service time S)",
           "what runs, the mean computing time of a result",
           "Liu & Layland, J. ACM 20(1), 1973, for a pool of workers",
           {{"most", "1", "utilisation, of all services together"}}},
          filtered_by_request<capacity>};
}

} // namespace sofof::policies
