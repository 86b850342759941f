// Tests of policies with governors behind them, as scenarios have them.
#include "tests/support/roadside.hpp"

#include <string>
#include <utility>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::backed_by;
using test::comes_home;
using test::goes_to;
using test::make_lodm_with;
using test::option_list;
using test::option_values;
using test::roadside;

namespace {

/// The policy "always" with one governor.
std::unique_ptr<local_policy> always_with(const std::string& governor,
                                          option_values options = {}) {
  options.lengths = {{"govern", 1}};
  options.texts["govern.0.name"] = governor;
  return make_lodm_with("always", options);
}

} // namespace

TEST_CASE("a policy has its governors in its title") {
  option_list options;
  options.lengths = {{"govern", 2}};
  options.texts = {{"govern.0.name", "predictive_gate"},
                   {"govern.1.name", "hysteresis"}};
  const auto lodm = make_lodm("nearest");
  CHECK(lodm->title() == "nearest");
  lodm->visit_options(options);
  CHECK(lodm->name() == "nearest");
  CHECK(lodm->title() == "nearest + predictive_gate + hysteresis");
  CHECK(lodm->clone()->title() == lodm->title());
}

TEST_CASE("nobody waits longer than ten seconds for a hedge") {
  option_list options;
  options.lengths = {{"govern", 1}};
  options.texts = {{"govern.0.name", "redundancy"}};
  options.times = {{"govern.0.hedge_after", 10'001ms}};
  make_lodm("always")->visit_options(options);
  CHECK(options.refused == decltype(options.refused){"govern.0.hedge_after"});
}

TEST_CASE("an unknown governor is refused") {
  option_list options;
  options.lengths = {{"govern", 1}};
  options.texts = {{"govern.0.name", "predictive_gait"}};
  make_lodm("always")->visit_options(options);
  CHECK(options.refused.contains("govern.0.name"));
}

TEST_CASE("whoever wants to be asked most often is asked as often") {
  CHECK(make_lodm("always")->epoch_s() == 0);
  CHECK(always_with("hysteresis")->epoch_s() == 0.1);
  CHECK(always_with("hysteresis", {.numbers = {{"govern.0.epoch_s", 0.02}}})
            ->epoch_s()
        == 0.02);
  CHECK(always_with("redundancy")->epoch_s() == 0);
}

TEST_CASE_FIXTURE(roadside, "behind a gate nobody is asked who may be late") {
  const auto lodm = always_with("predictive_gate");
  add(1).link.late = 0.01;
  CHECK(!goes_to(ask(*lodm)));
  CHECK(ask(*lodm).why == "late results are likely");
  providers[0].link.late = 0.005;
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[0].link.late = 0.02; // it is open
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(roadside, "it comes home when late results are likely, not "
                            "because nothing is known yet") {
  const auto lodm = always_with("predictive_gate");
  add(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  runs_at(1);
  providers[0].link = {};
  CHECK(!comes_home(ask(*lodm)));
  providers[0].link = {0.021, 0, 20ms, 30ms};
  CHECK(comes_home(ask(*lodm)));
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside,
                  "a gate lets a service go on from a bad provider to "
                  "a good one, and from a bad one to a bad one home") {
  const auto lodm = make_lodm_with(
      "nearest", {.texts = {{"govern.0.name", "predictive_gate"}},
                  .lengths = {{"govern", 1}}});
  add(1, {50, 0});
  add(2, {10, 0});
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 2);
  providers[0].link.late = 0.5;
  CHECK(goes_to(ask(*lodm)) == 2);
  providers[1].link.late = 0.5;
  CHECK(comes_home(ask(*lodm)));
  providers[0].link.late = 0;
  CHECK(!comes_home(ask(*lodm)));
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside, "behind redundancy, a gate takes away the one of "
                            "two that may be late") {
  const auto lodm =
      make_lodm_with("always", {.texts = {{"govern.0.name", "redundancy"},
                                          {"govern.1.name", "predictive_gate"}},
                                .lengths = {{"govern", 2}}});
  add(1);
  add(2);
  runs_at(1);
  SUBCASE("both are in time") {
    CHECK(backed_by(ask(*lodm)) == 2);
    CHECK(!comes_home(ask(*lodm)));
  }
  SUBCASE("the second may be late") {
    providers[1].link = {0.5, 0, 20ms, 30ms};
    CHECK(!backed_by(ask(*lodm)));
    CHECK(!comes_home(ask(*lodm)));
  }
  SUBCASE("the first may be late") {
    providers[0].link = {0.5, 0, 20ms, 30ms};
    CHECK(goes_to(ask(*lodm)) == 2);
    CHECK(!backed_by(ask(*lodm)));
  }
  SUBCASE("both may be late") {
    for (auto& provider : providers)
      provider.link = {0.5, 0, 20ms, 30ms};
    CHECK(comes_home(ask(*lodm)));
  }
}

TEST_CASE_FIXTURE(roadside,
                  "each service has gates of its own, and so has each "
                  "clone") {
  const auto lodm = always_with("predictive_gate");
  add(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  const auto other = lodm->clone();
  providers[0].link.late = 0.01;
  CHECK(goes_to(ask(*lodm)) == 1);
  CHECK(goes_to(ask(*other)) == 1);
  providers[0].link.late = 0.03;
  CHECK(!goes_to(ask(*other)));
  providers[0].link.late = 0.01;
  CHECK(!goes_to(ask(*other)));
  CHECK(goes_to(ask(*lodm)) == 1);
  seen.service = "other";
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside,
                  "hysteresis waits until somebody was wanted for half "
                  "a second") {
  const auto lodm = always_with("hysteresis");
  add(1);
  for (int k = 0; k < 5; ++k) {
    CHECK(!goes_to(ask(*lodm)));
    pass(100ms);
  }
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(roadside,
                  "hysteresis keeps nobody from coming home, and then "
                  "waits for two seconds") {
  option_values options;
  options.texts = {{"govern.0.name", "hysteresis"}};
  options.lengths = {{"govern", 1}};
  const auto lodm = make_lodm_with("greedy_gain", options);
  add(1);
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[0].link.late = 1;
  pass(10ms);
  CHECK(comes_home(ask(*lodm)));
  runs_at(std::nullopt);
  const auto home = seen.now;
  providers[0].link.late = 0;
  while (!goes_to(ask(*lodm)) && seen.now < home + 10s)
    pass(100ms);
  CHECK(seen.now == home + 2s);
}

TEST_CASE_FIXTURE(roadside, "after a fallback that nobody decided hysteresis "
                            "waits as well") {
  const auto lodm = always_with("hysteresis");
  add(1);
  seen.now += 100s;
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  pass(5s);
  runs_at(std::nullopt); // a violation
  const auto home = seen.now;
  while (!goes_to(ask(*lodm)) && seen.now < home + 10s)
    pass(100ms);
  CHECK(seen.now == home + 2s);
}

TEST_CASE_FIXTURE(roadside, "an advantage of the margin is no reason to go") {
  option_values options;
  options.texts = {{"govern.0.name", "hysteresis"}};
  options.numbers = {{"govern.0.margin", 0.4}};
  options.lengths = {{"govern", 1}};
  const auto lodm = make_lodm_with("greedy_gain", options);
  add(1); // wins 0.13
  for (int k = 0; k < 50; ++k) {
    CHECK(!goes_to(ask(*lodm)));
    pass(100ms);
  }
}

TEST_CASE_FIXTURE(roadside, "with redundancy the one that is late least often "
                            "plans too") {
  const auto lodm = always_with("redundancy");
  add(1).link.late = 0.01;
  CHECK(!backed_by(ask(*lodm)));
  add(2).link.late = 0.2;
  add(3).link.late = 0.1;
  CHECK(goes_to(ask(*lodm)) == 1);
  CHECK(backed_by(ask(*lodm)) == 3);
  runs_at(1);
  CHECK(backed_by(ask(*lodm)) == 3);
}

TEST_CASE_FIXTURE(roadside,
                  "who is rarely late needs no second, and the second "
                  "ends") {
  const auto lodm =
      always_with("redundancy", {.numbers = {{"govern.0.least_late", 0.02}}});
  add(1).link.late = 0.02;
  add(2).link.late = 0.5;
  runs_at(1);
  CHECK(backed_by(ask(*lodm)) == 2);
  providers[0].link.late = 0.019;
  CHECK(!backed_by(ask(*lodm)));
  CHECK(goes_to(ask(*lodm)) == 1); // there, and nowhere else
}

TEST_CASE_FIXTURE(roadside, "the second plans all cycles, or may be kept for "
                            "those that are not answered") {
  add(1);
  add(2);
  CHECK(second_of(ask(*always_with("redundancy"))).value().hedge_after
        == duration{0});
  const auto lodm =
      always_with("redundancy", {.times = {{"govern.0.hedge_after", 20ms}}});
  CHECK(backed_by(ask(*lodm)) == 2);
  CHECK(second_of(ask(*lodm)).value().hedge_after == 20ms);
}

TEST_CASE_FIXTURE(roadside, "who stays on board needs no second") {
  option_values options;
  options.texts = {{"govern.0.name", "redundancy"}};
  options.lengths = {{"govern", 1}};
  add(1);
  add(2);
  CHECK(!backed_by(ask(*make_lodm_with("never", options))));
  const auto lodm = make_lodm_with("greedy_gain", options);
  for (auto& provider : providers)
    provider.link.late = 1;
  runs_at(1);
  CHECK(comes_home(ask(*lodm)));
  CHECK(!backed_by(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside,
                  "governors follow each other: whom hysteresis holds "
                  "back nobody doubles") {
  using names = std::pair<std::string, std::string>;
  add(1);
  add(2);
  for (const auto& [first, second] :
       {names{"redundancy", "hysteresis"}, names{"hysteresis", "redundancy"}}) {
    const auto lodm = make_lodm_with(
        "always",
        {.texts = {{"govern.0.name", first}, {"govern.1.name", second}},
         .lengths = {{"govern", 2}}});
    seen.now = {};
    for (int k = 0; k < 5; ++k) {
      const auto decision = ask(*lodm);
      CHECK(!goes_to(decision));
      CHECK(!backed_by(decision));
      pass(100ms);
    }
    const auto decision = ask(*lodm);
    CHECK(goes_to(decision) == 1);
    CHECK(backed_by(decision) == 2);
  }
}

TEST_CASE_FIXTURE(roadside, "nobody is asked while the scene leaves less time "
                            "than a response may take, and what runs comes "
                            "home") {
  const auto lodm = always_with("rss");
  CHECK(lodm->needs_scene());
  CHECK(!always_with("hysteresis")->needs_scene());
  add(1);
  seen.needs.worst_response = 600ms;
  seen.safe_response = 899ms;
  CHECK(!goes_to(ask(*lodm)));
  CHECK(ask(*lodm).why == "not safe under its response time");
  seen.safe_response = 900ms;
  CHECK(goes_to(ask(*lodm)) == 1);
  runs_at(1);
  seen.safe_response = 700ms;
  CHECK(!comes_home(ask(*lodm)));
  seen.safe_response = 699ms;
  CHECK(comes_home(ask(*lodm)));
}

TEST_CASE_FIXTURE(roadside, "between the margins a change home is foreseen") {
  const auto lodm = always_with("rss");
  add(1);
  runs_at(1);
  seen.needs.worst_response = 600ms;
  CHECK(!lodm->foresees_home(seen));
  seen.safe_response = 900ms;
  CHECK(!lodm->foresees_home(seen));
  seen.safe_response = 899ms;
  CHECK(lodm->foresees_home(seen));
  CHECK(!comes_home(ask(*lodm)));
  CHECK(!always_with("hysteresis")->foresees_home(seen));
}

TEST_CASE_FIXTURE(roadside,
                  "what runs at one provider goes to another one only "
                  "with the margin of who leaves home") {
  const auto lodm = make_lodm_with(
      "nearest", {.texts = {{"govern.0.name", "rss"}, {"filter", "none"}},
                  .lengths = {{"govern", 1}}});
  seen.needs.worst_response = 600ms;
  add(1, {200, 0});
  add(2, {20, 0});
  runs_at(1);
  seen.safe_response = 900ms;
  CHECK(goes_to(ask(*lodm)) == 2);
  seen.safe_response = 899ms;
  CHECK(!goes_to(ask(*lodm)));
  CHECK(!comes_home(ask(*lodm)));
  runs_at(2); // the nearest already
  CHECK(ask(*lodm).why != "not safe under its response time");
}

TEST_CASE_FIXTURE(roadside, "a service that knows nothing of the scene goes "
                            "where it likes; one that does, and whose inputs "
                            "may be of any age, stays at home") {
  const auto lodm = always_with("rss");
  add(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  seen.safe_response = 1000h;
  CHECK(!goes_to(ask(*lodm)));
}

namespace {

/// A vehicle that knows at which place ahead results are late.
struct warned_vehicle : roadside {
  std::vector<provider_forecast> ahead;
  std::unique_ptr<local_policy> gated = always_with("predictive_gate");

  /// @param in_s  Until the vehicle is there.
  void expect(provider_id provider, double in_s, double late) {
    ahead.push_back({provider, {{0, 0.01, 0.02}, {in_s, late, 0.08}}});
    seen.forecasts = ahead;
  }
};

} // namespace

TEST_CASE("a gate wants a forecast by place, unless it looks at none") {
  CHECK(always_with("predictive_gate")->needs_forecast());
  CHECK(!always_with("hysteresis")->needs_forecast());
  CHECK(!always_with("predictive_gate",
                     {.times = {{"govern.0.leave_before", 0s},
                                {"govern.0.begin_before", 0s}}})
             ->needs_forecast());
}

TEST_CASE_FIXTURE(warned_vehicle,
                  "a service comes home before a bad place, not long before") {
  add(1);
  CHECK(goes_to(ask(*gated)) == 1);
  runs_at(1);
  expect(1, 1.5, 0.9);
  CHECK(!comes_home(ask(*gated)));
  ahead[0].along[1].in_s = 1;
  CHECK(comes_home(ask(*gated)));
  CHECK(ask(*gated).why == "late results are likely ahead");
  ahead[0].along[1].late = 0.2; // not above
  CHECK(!comes_home(ask(*gated)));
}

TEST_CASE_FIXTURE(warned_vehicle,
                  "it comes home also when nothing is known of the link yet") {
  add(1);
  CHECK(goes_to(ask(*gated)) == 1);
  runs_at(1);
  providers[0].link = {};
  CHECK(!comes_home(ask(*gated)));
  expect(1, 0.5, 0.9);
  CHECK(comes_home(ask(*gated)));
}

TEST_CASE_FIXTURE(
    warned_vehicle,
    "nobody is asked with a bad place nearer than three seconds") {
  add(1);
  expect(1, 2.9, 0.9);
  CHECK(!goes_to(ask(*gated)));
  CHECK(ask(*gated).why == "late results are likely ahead");
  ahead[0].along[1].in_s = 3.1;
  CHECK(goes_to(ask(*gated)) == 1);
}

TEST_CASE_FIXTURE(warned_vehicle,
                  "before a bad place a service goes on to a provider that is "
                  "fine there") {
  const auto nearest = make_lodm_with(
      "nearest", {.texts = {{"govern.0.name", "predictive_gate"}},
                  .lengths = {{"govern", 1}}});
  add(1, {50, 0});
  add(2, {10, 0});
  runs_at(1);
  expect(1, 0.5, 0.9);
  CHECK(goes_to(ask(*nearest)) == 2);
}

TEST_CASE_FIXTURE(warned_vehicle, "whoever does not look at places goes on") {
  const auto blind = always_with("predictive_gate",
                                 {.times = {{"govern.0.leave_before", 0s},
                                            {"govern.0.begin_before", 0s}}});
  add(1);
  CHECK(goes_to(ask(*blind)) == 1);
  runs_at(1);
  expect(1, 0.5, 0.9);
  CHECK(!comes_home(ask(*blind)));
}

TEST_CASE_FIXTURE(warned_vehicle,
                  "an own function is told to warm up before a bad place") {
  add(1);
  runs_at(1);
  seen.providers = providers;
  expect(1, 2.9, 0.9);
  CHECK(gated->foresees_home(seen));
  ahead[0].along[1].in_s = 3.1;
  CHECK(!gated->foresees_home(seen));
}

TEST_CASE("forecasts reach ten seconds, so that no gate looks farther") {
  option_list options;
  options.lengths = {{"govern", 1}};
  options.texts = {{"govern.0.name", "predictive_gate"}};
  options.times = {{"govern.0.leave_before", 10'001ms}};
  make_lodm("always")->visit_options(options);
  CHECK(options.refused == decltype(options.refused){"govern.0.leave_before"});
}
