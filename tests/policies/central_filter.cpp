// Tests of a CODM behind a filter: whose decision is whose.
#include "policies/filtered.hpp"
#include "tests/policies/scene.hpp"

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;
using namespace sofof::world;

namespace {

/// Says yes to so many, and is rid of all sessions if it comes to them.
class brief final : public central_policy {
public:
  explicit brief(std::size_t count) : count_{count} {}
  std::vector<central_decision>
  decide(const central_context& context) override {
    std::vector<central_decision> all;
    for (std::size_t k = 0; k < count_; ++k)
      all.push_back(k < context.requests.size()
                        ? central_decision{accepted{}, "brief"}
                        : central_decision{refused{}, "brief"});
    return all;
  }
  std::string_view name() const override { return "brief"; }
  std::unique_ptr<central_policy> clone() const override {
    return std::make_unique<brief>(*this);
  }

private:
  std::size_t count_;
};

/// Four requests, of which the filter stops the second, and two sessions.
std::string behind_a_filter(std::size_t count) {
  scene at;
  at.ask_alike(4, 0.1, 0.2);
  at.run(0.1, {});
  at.run(0.1, {});
  const polygon area{{{-100, -100}, {200, -100}, {200, 100}, {-100, 100}}};
  const road_map map{
      "street",
      {},
      {{"street", {{-500, 0}, {500, 0}}, 1.75, {{0, 14}}, {}, 0}}};
  const std::vector<point> inside{{0, 0}, {200, 0}}, off{{0, 50}, {200, 50}};
  for (auto& r : at.requests)
    r.route = inside;
  at.requests[1].route = off;
  filtered_codm codm{std::make_unique<brief>(count)};
  std::string all;
  for (const auto& d :
       codm.decide({time_point{}, at.requests, at.sessions, 0, 1, area, map})) {
    CHECK(!d.why.empty());
    all += is_accepted(d) ? 'h' : d.why == "not decided" ? '?' : '-';
  }
  return all;
}

} // namespace

TEST_CASE("what a choice leaves out is refused, also behind a filter") {
  CHECK(behind_a_filter(0) == "?-??");
  CHECK(behind_a_filter(1) == "h-??");
  CHECK(behind_a_filter(2) == "h-h?");
}

TEST_CASE(
    "what a choice says of sessions is of the same ones behind a filter") {
  CHECK(behind_a_filter(3) == "h-hh");
  CHECK(behind_a_filter(4) == "h-hh-");
  CHECK(behind_a_filter(5) == "h-hh--");
}
