// Tests of learners as decisions of a vehicle; their cores have tests of their
// own.
#include "policies/algorithms/learning/offloading_state.hpp"
#include "tests/support/roadside.hpp"
#include "tests/support/toy_drive.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::after;
using test::comes_home;
using test::goes_to;
using test::make_lodm_with;
using test::mean_cost;
using test::roadside;

namespace {

constexpr std::array<std::string_view, 2> learners{"q_learning", "dqn"};

std::unique_ptr<local_policy> pupil(std::string_view name) {
  return make_lodm_with(name, {.flags = {{"learning", true}}});
}

} // namespace

TEST_CASE_FIXTURE(roadside, "states tell time left, latency, load and place "
                            "apart, in 160 cells") {
  auto& one = add(1, {0, 0});
  seen.path = path;
  std::set<std::size_t> cells;
  for (const double speed_mps : {200.0, 100.0, 30.0, 1.0})
    for (const auto p99 : {20ms, 30ms, 45ms, 60ms, 80ms})
      for (const double load : {0.3, 0.6, 0.8, 2.0})
        for (const bool is_remote : {false, true}) {
          seen.speed_mps = speed_mps;
          one.link.p99 = p99;
          one.utilisation = load;
          cells.insert(cell_of({seen, one, is_remote}));
        }
  CHECK(cells.size() == offloading_cells);
  CHECK(*cells.rbegin() == offloading_cells - 1);
}

TEST_CASE_FIXTURE(roadside, "what is unknown counts as the worst") {
  auto& one = add(1, {0, 0});
  seen.path = path;
  one.link.p99 = 80ms;
  const auto worst = cell_of({seen, one});
  one.link.p99 = std::nullopt;
  CHECK(cell_of({seen, one}) == worst);
  one.link.p99 = 20ms;
  CHECK(cell_of({seen, one}) != worst);
  one.utilisation = std::numeric_limits<double>::quiet_NaN();
  CHECK(cell_of({seen, one}) % 8 == 6);
}

TEST_CASE_FIXTURE(roadside,
                  "features are numbers from 0 to 1 whatever is said") {
  const auto no_number = std::numeric_limits<double>::quiet_NaN();
  auto& one = add(1);
  for (const double value : {0.0, -1e9, 1e9, no_number}) {
    seen.speed_mps = value;
    one.utilisation = value;
    one.computing_s = std::clamp(value, -1e3, 1e3);
    one.link = {value, value, {}, {}};
    one.cost.energy_j = value;
    if (!(value == value))
      one.computing_s = 0;
    for (const auto feature : features_of({seen, one}))
      CHECK((feature >= 0 && feature <= 1));
  }
}

TEST_CASE("what has been learned is cheaper than to offload always or never") {
  const auto always = mean_cost(*make_lodm("always"), 1, 300);
  const auto never = mean_cost(*make_lodm("never"), 1, 300);
  for (const auto name : learners) {
    CAPTURE(name);
    const auto taught = pupil(name);
    mean_cost(*taught, 10'000, name == "dqn" ? 200 : 2000);
    const auto lodm = make_lodm(name);
    REQUIRE(!lodm->restore(taught->snapshot()));
    CHECK(mean_cost(*lodm, 1, 300) < 0.9 * std::min(always, never));
  }
}

TEST_CASE("what is frozen learns nothing, and decides the same as its clone") {
  for (const auto name : learners) {
    const auto lodm = make_lodm(name);
    const auto text = lodm->snapshot();
    CHECK(!text.empty());
    const auto cost = mean_cost(*lodm, 1, 20);
    CHECK(lodm->snapshot() == text);
    CHECK(mean_cost(*lodm->clone(), 1, 20) == cost);
  }
}

TEST_CASE("who learns begins with nothing and gets better") {
  for (const auto name : learners) {
    CAPTURE(name);
    const auto lodm = pupil(name);
    const auto begin = lodm->snapshot();
    CHECK(begin != make_lodm(name)->snapshot());
    mean_cost(*lodm, 5000, 60);
    const auto before = make_lodm(name);
    const auto after = make_lodm(name);
    REQUIRE(!before->restore(begin));
    REQUIRE(!after->restore(lodm->snapshot()));
    CHECK(mean_cost(*after, 1, 100) < mean_cost(*before, 1, 100));
  }
}

TEST_CASE("all clones teach one mind, in a run that is repeated the same one") {
  for (const auto name : learners) {
    const auto teach = [name] {
      const auto prototype = pupil(name);
      const auto one = prototype->clone();
      const auto other = prototype->clone();
      mean_cost(*one, 1, 5);
      mean_cost(*other, 10, 5);
      CHECK(one->snapshot() == prototype->snapshot());
      CHECK(other->snapshot() == prototype->snapshot());
      return prototype->snapshot();
    };
    const auto text = teach();
    CHECK(text != pupil(name)->snapshot());
    CHECK(teach() == text);
  }
}

TEST_CASE("a snapshot goes from one who learns to one who is frozen, and the "
          "other way round") {
  for (const auto name : learners) {
    const auto lodm = pupil(name);
    mean_cost(*lodm, 1, 5);
    const auto frozen = make_lodm(name);
    CHECK(!frozen->restore(lodm->snapshot()));
    CHECK(frozen->snapshot() == lodm->snapshot());
    const auto next = pupil(name);
    CHECK(!next->restore(frozen->snapshot()));
    CHECK(next->snapshot() == lodm->snapshot());
    CHECK(frozen->restore("sofof nonsense 1"));
    CHECK(frozen->snapshot() == lodm->snapshot());
  }
}

TEST_CASE_FIXTURE(roadside, "while it learns it decides once an epoch, however "
                            "often it is asked") {
  const auto lodm = make_lodm_with(
      "q_learning", {.numbers = {{"explore_first", 1}, {"explore_last", 1}},
                     .flags = {{"learning", true}}});
  add(1);
  int asked = 0, refused = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto decision = ask(*lodm);
    refused += decision.why == "not yet" ? 1 : 0;
    asked += goes_to(decision) == 1 ? 1 : 0;
    lodm->observe(cycle(false, 2));
    pass(100ms);
  }
  CHECK(refused == 800);
  CHECK(asked == doctest::Approx(100).epsilon(0.2));
}

TEST_CASE_FIXTURE(roadside,
                  "the reward of a step is what its cycles cost in the "
                  "mean, and its changes") {
  const auto lodm = make_lodm_with(
      "q_learning",
      {.numbers = {{"explore_first", 0}, {"explore_last", 0}, {"discount", 0}},
       .flags = {{"learning", true}}});
  add(1);
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1); // keeps, of equals
  for (int k = 0; k < 9; ++k)
    lodm->observe(cycle());
  lodm->observe(cycle(true));
  lodm->observe(
      episode_outcome{"any", 1, 1, "qos_latency"}); // a change for the worse
  pass(500ms);
  runs_at(std::nullopt);
  ask(*lodm);
  const auto expected = -(0.3 * 10 / 27 + 0.1) - 0.2;
  const auto text = lodm->snapshot();
  double found = 0;
  for (std::size_t at = text.find('\n'); at != text.npos;
       at = text.find('\n', at + 1))
    if (text[at + 1] == '-')
      found = std::stod(text.substr(at + 1));
  CHECK(found == doctest::Approx(expected));
}

TEST_CASE_FIXTURE(roadside, "a learner that would come home goes on to another "
                            "provider where that pays") {
  // Taught that it pays to be remote at idle providers and not at busy ones.
  const auto lodm = make_lodm_with(
      "q_learning", {.numbers = {{"explore_first", 1}, {"explore_last", 1}},
                     .flags = {{"learning", true}}});
  add(1);
  for (int k = 0; k < 4000; ++k) {
    providers[0].utilisation = k / 20 % 2 == 0 ? 0.2 : 1.0;
    const auto decision = ask(*lodm);
    if (const auto to = after(decision, seen.current); to != seen.current)
      runs_at(to);
    const auto is_late = seen.current && providers[0].utilisation > 0.5;
    lodm->observe(cycle(is_late, 10));
    pass(500ms);
  }
  const auto frozen = make_lodm("q_learning");
  REQUIRE(!frozen->restore(lodm->snapshot()));
  runs_at(std::nullopt);
  providers[0].utilisation = 0.2;
  CHECK(goes_to(ask(*frozen)) == 1);
  providers[0].utilisation = 1;
  CHECK(!goes_to(ask(*frozen)));
  runs_at(1);
  CHECK(comes_home(ask(*frozen)));
  add(2).utilisation = 0.2;
  CHECK(goes_to(ask(*frozen)) == 2);
}
