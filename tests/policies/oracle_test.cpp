// Tests of who knows the future.
#include "tests/support/roadside.hpp"

#include <map>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::comes_home;
using test::goes_to;
using test::roadside;

namespace {

/// What is said of each provider, of one kind of service.
struct foretold final : channel_oracle {
  std::map<provider_id, time_point> late;
  std::map<provider_id, double> latency_s; // 20 ms of others

  foreseen_results look(provider_id provider, std::string_view kind,
                        time_point from, time_point until) const override {
    CHECK(kind == "any");
    const auto time = latency_s.find(provider);
    foreseen_results seen{{}, time == latency_s.end() ? 0.02 : time->second};
    const auto i = late.find(provider);
    if (i != late.end() && i->second >= from && i->second < until)
      seen.late = i->second;
    return seen;
  }
};

struct with_foresight : roadside {
  foretold future;
  std::unique_ptr<local_policy> lodm = make_lodm("oracle");

  with_foresight() { seen.future = &future; }
  void late_in(provider_id id, duration time) {
    future.late[id] = seen.now + time;
  }
};

} // namespace

TEST_CASE_FIXTURE(roadside, "who has no foresight stays on board and says so") {
  add(1);
  const auto decision = ask(*make_lodm("oracle"));
  CHECK(!goes_to(decision));
  CHECK(decision.why == "no foresight here");
}

TEST_CASE_FIXTURE(with_foresight,
                  "it goes where nothing is late for a second") {
  add(1);
  late_in(1, 999ms);
  CHECK(!goes_to(ask(*lodm)));
  late_in(1, 1s);
  CHECK(goes_to(ask(*lodm)) == 1);
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(with_foresight,
                  "of several that stay good the one of most gain to come") {
  add(1);
  add(2);
  late_in(1, 3s);
  late_in(2, 4s);
  future.latency_s = {{1, 0.015}};
  providers[0].link.late = 0.5; // it knows better
  providers[0].link.median = 45ms;
  CHECK(goes_to(ask(*lodm)) == 1);
  providers[1].cost.energy_j = 0.001;
  CHECK(goes_to(ask(*lodm)) == 2);
  late_in(2, 900ms);
  CHECK(goes_to(ask(*lodm)) == 1);
}

TEST_CASE_FIXTURE(with_foresight, "it moves for more than the margin only") {
  add(1);
  add(2);
  runs_at(1);
  future.latency_s = {{2, 0.019}}; // 0.3 / 50 of 0.01
  CHECK(goes_to(ask(*lodm)) == 1);
  future.latency_s = {{2, 0.017}};
  CHECK(goes_to(ask(*lodm)) == 2);
}

TEST_CASE_FIXTURE(with_foresight, "what costs more than on board is no gain") {
  auto& there = add(1);
  there.cost.energy_j = 0.1;
  CHECK(!goes_to(ask(*lodm)));
  there.cost.energy_j = 0.001;
  CHECK(goes_to(ask(*lodm)) == 1);
  runs_at(1);
  providers[0].cost.energy_j = 0.1;
  CHECK(comes_home(ask(*lodm)));
}

TEST_CASE_FIXTURE(with_foresight,
                  "who looks no time ahead asks nobody who is late at once") {
  lodm = test::make_lodm_with("oracle", {.times = {{"lookahead", 0s}}});
  add(1);
  late_in(1, 0s);
  CHECK(!goes_to(ask(*lodm)));
}

TEST_CASE_FIXTURE(with_foresight,
                  "it leaves just before the first late result, "
                  "and not sooner") {
  add(1);
  late_in(1, 400ms);
  runs_at(1);
  int looks = 0;
  while (!comes_home(ask(*lodm))) {
    ++looks;
    REQUIRE(looks < 20);
    pass(from_seconds(lodm->epoch_s()));
  }
  CHECK(seen.now + from_seconds(lodm->epoch_s()) >= future.late[1]);
  CHECK(seen.now < future.late[1]);
}

TEST_CASE_FIXTURE(with_foresight, "it goes on to another one as soon as that "
                                  "stays good and this one does not") {
  add(1);
  add(2);
  late_in(2, 5s);
  runs_at(1);
  CHECK(goes_to(ask(*lodm)) == 1);
  late_in(1, 900ms);
  CHECK(goes_to(ask(*lodm)) == 2);
}
