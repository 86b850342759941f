// A watch beside a policy changes nothing about it.
#include "scenario/decision_timer.hpp"

#include "base/options/option_printer.hpp"
#include "tests/support/decisions.hpp"

#include <doctest/doctest.h>

#include <map>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::scenario;
using test::goes_to;

namespace {

/// Says which provider it wants, and counts what it is told.
class picky final : public local_policy {
public:
  struct told {
    int cycles = 0, episodes = 0;
  };

  explicit picky(told& to) : to_{to} {}

  local_decision decide(const local_context&) override {
    return {run_at{wanted_}, "because"};
  }
  reason objection(const local_context&,
                   const provider_view& x) const override {
    return x.id == wanted_ ? "" : "not wanted";
  }
  void observe(const cycle_outcome&) override { ++to_.cycles; }
  void observe(const episode_outcome&) override { ++to_.episodes; }
  void visit_options(option_visitor& s) override {
    auto wanted = static_cast<std::int64_t>(wanted_.value());
    s.field("wanted", wanted, {0, 9});
    wanted_ = static_cast<provider_id>(wanted);
  }
  std::string_view name() const override { return "picky"; }
  std::unique_ptr<local_policy> clone() const override {
    return std::make_unique<picky>(*this);
  }

private:
  told& to_;
  provider_id wanted_ = 7;
};

local_context nothing_offered() {
  return {.now = time_point{}, .service = "any", .providers = {}, .path = {}};
}

} // namespace

TEST_CASE("a timed policy is and does what the policy is and does") {
  picky::told told;
  policy_options policies;
  policies.lodm = std::make_shared<picky>(told);
  const auto plain = policies.lodm;
  add_timers(policies);
  REQUIRE(policies.lodm != plain);
  auto& timed = *policies.lodm;
  CHECK(timed.name() == "picky");
  CHECK(goes_to(timed.decide(nothing_offered())) == 7);
  CHECK(timed.clone()->decide(nothing_offered()).why == "because");
  CHECK(timed.objection(nothing_offered(), {7}).empty());
  CHECK(timed.objection(nothing_offered(), {8}) == "not wanted");
  timed.observe(cycle_outcome{});
  timed.clone()->observe(episode_outcome{});
  CHECK(told.cycles == 1);
  CHECK(told.episodes == 1);
  CHECK(print_options([&](option_visitor& s) { timed.visit_options(s); })
        == "wanted = 7\n");
}

TEST_CASE("the decisions of all clones are timed together") {
  picky::told told;
  policy_options policies;
  policies.lodm = std::make_shared<picky>(told);
  const auto times = add_timers(policies);
  CHECK(times.figures().empty());
  policies.lodm->decide(nothing_offered());
  const auto clone = policies.lodm->clone();
  for (int i = 0; i < 4; ++i)
    clone->decide(nothing_offered());
  const auto list = times.figures();
  const std::map<std::string, double> figures(list.begin(), list.end());
  CHECK(figures.size() == 5); // nothing of the other side
  CHECK(figures.at("lodm_decisions") == 5);
  CHECK(figures.at("lodm_decide_p50_us") > 0);
  CHECK(figures.at("lodm_decide_p50_us") <= figures.at("lodm_decide_p99_us"));
  CHECK(figures.at("lodm_decide_p99_us") <= figures.at("lodm_decide_max_us"));
  CHECK(figures.at("lodm_decide_mean_us") <= figures.at("lodm_decide_max_us"));
}
