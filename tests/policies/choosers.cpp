// Tests of what holds for every LODM, however it decides.
#include "tests/support/dice.hpp"
#include "tests/support/roadside.hpp"

#include <algorithm>
#include <limits>

using namespace sofof;
using namespace sofof::policies;
using test::backed_by;
using test::comes_home;
using test::dice;
using test::goes_to;
using test::roadside;

namespace {

/// Some providers, good and bad ones and such that talk nonsense.
void scatter(roadside& at, dice& random) {
  at.providers.clear();
  const auto count = static_cast<int>(random.between(0, 5));
  for (int k = 0; k < count; ++k) {
    const provider_id id =
        static_cast<provider_id::rep>(random.between(1, 9)) * 10
        + static_cast<provider_id::rep>(k);
    auto& one =
        at.add(id, {random.between(-400, 400), random.between(-400, 400)});
    one.utilisation = random.between(-1, 3);
    one.link.late = random.between(-0.5, 1.5);
    one.cost.energy_j = random.between(0, 0.05);
    if (random.between(0, 1) < 0.2)
      one.link = {};
    if (random.between(0, 1) < 0.1)
      one.utilisation = std::numeric_limits<double>::quiet_NaN();
    if (random.between(0, 1) < 0.1)
      one.cost.energy_j = std::numeric_limits<double>::infinity();
    if (random.between(0, 1) < 0.1)
      one.at.x_m = std::numeric_limits<double>::quiet_NaN();
    if (random.between(0, 1) < 0.1)
      one.computing_s = 0;
    if (random.between(0, 1) < 0.1)
      one.workers = 0;
  }
}

} // namespace

TEST_CASE("nobody outside the context is ever chosen, and a decision that is "
          "made again is the same") {
  for (const auto name : lodm_names()) {
    CAPTURE(name);
    dice random{5};
    const auto lodm = make_lodm(name);
    roadside at;
    for (at.seen.number = 0; at.seen.number < 2000; ++at.seen.number) {
      scatter(at, random);
      const auto is_remote =
          !at.providers.empty() && random.between(0, 1) < 0.5;
      at.runs_at(is_remote ? service_place{at.providers.front().id}
                           : std::nullopt);
      const auto decision = at.ask(*lodm);
      for (const auto id : {goes_to(decision), backed_by(decision)})
        REQUIRE(
            (!id
             || std::ranges::count(at.providers, id, &provider_view::id) > 0));
      REQUIRE(!(comes_home(decision) && !is_remote));
      REQUIRE(!decision.why.empty());
      const auto again = at.ask(*lodm);
      REQUIRE(goes_to(again) == goes_to(decision));
      REQUIRE(comes_home(again) == comes_home(decision));
      at.pass(std::chrono::milliseconds{700});
      lodm->observe(at.cycle(random.between(0, 1) < 0.1, 14));
    }
  }
}

TEST_CASE("what learns can be restored, and what learns nothing says so") {
  for (const auto name : lodm_names()) {
    CAPTURE(name);
    const auto lodm = make_lodm(name);
    const auto text = lodm->snapshot();
    if (text.empty())
      CHECK(lodm->restore("anything"));
    else
      CHECK(!lodm->restore(text));
    CHECK(lodm->snapshot() == text);
  }
}
