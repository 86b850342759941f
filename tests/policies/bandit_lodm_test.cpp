// Tests of the bandits as decisions of a vehicle; their cores have tests of
// their own.
#include "tests/support/roadside.hpp"

#include <limits>
#include <map>
#include <string>

using namespace sofof;
using namespace sofof::policies;
using namespace std::chrono_literals;
using test::after;
using test::goes_to;
using test::make_lodm_with;
using test::on_board;
using test::roadside;

namespace {

/// A vehicle that follows what a bandit says, at once.
struct follower : roadside {
  std::map<service_place, int> seconds; ///< Where it planned.

  /// Latencies of each provider; those above 50 ms are missed.
  std::map<provider_id, double> latency_s;

  void drive(local_policy& lodm, int for_s) {
    for (int k = 0; k < for_s; ++k) {
      const auto decision = ask(lodm);
      const auto to = after(decision, seen.current);
      if (to != seen.current)
        runs_at(to);
      ++seconds[seen.current];
      auto one = cycle(false, 20);
      if (seen.current)
        one.latency_s = latency_s.at(*seen.current);
      one.missed = one.latency_s > 0.05;
      lodm.observe(one);
      pass(1s);
    }
  }
};

} // namespace

TEST_CASE_FIXTURE(follower,
                  "a trial lasts two seconds, and every place is tried "
                  "in turn") {
  const auto lodm = make_lodm("ucb1");
  add(1);
  add(2);
  latency_s = {{1, 0.02}, {2, 0.02}};
  std::vector<service_place> way;
  for (int k = 0; k < 6; ++k) {
    drive(*lodm, 1);
    way.push_back(seen.current);
  }
  CHECK(way == std::vector<service_place>{on_board, on_board, 1, 1, 2, 2});
}

TEST_CASE_FIXTURE(follower,
                  "ALTO stays where it is when no provider comes into "
                  "question any more") {
  const auto lodm = make_lodm("alto");
  add(1);
  REQUIRE(goes_to(ask(*lodm)) == 1);
  runs_at(1);
  providers[0].at = {1e6, 0};
  for (int k = 0; k < 3; ++k) {
    pass(3s);
    CHECK(goes_to(ask(*lodm)) == 1);
  }
}

TEST_CASE_FIXTURE(follower, "UCB1 is most where a cycle costs least, on board "
                            "not excepted") {
  add(1);
  add(2);
  add(3);
  latency_s = {{1, 0.045}, {2, 0.02}, {3, 0.06}};
  drive(*make_lodm("ucb1"), 20'000);
  CHECK(seconds[2] > seconds[on_board]);
  CHECK(seconds[on_board] > 2 * seconds[3]);
  seconds.clear();
  latency_s = {{1, 0.06}, {2, 0.06}, {3, 0.06}};
  runs_at(std::nullopt);
  drive(*make_lodm("ucb1"), 20'000);
  CHECK(seconds[on_board] > seconds[1] + seconds[2] + seconds[3]);
}

TEST_CASE_FIXTURE(follower,
                  "ALTO is most where results are quickest, and never "
                  "comes home by itself") {
  const auto lodm = make_lodm("alto");
  add(1);
  add(2);
  latency_s = {{1, 0.04}, {2, 0.015}};
  drive(*lodm, 2000);
  CHECK(seconds[on_board] == 0);
  CHECK(seconds[2] > 4 * seconds[1]);
  // A quicker one that appears late is found.
  add(3);
  latency_s[3] = 0.002;
  seconds.clear();
  drive(*lodm, 2000);
  CHECK(seconds[3] > seconds[1] + seconds[2]);
}

TEST_CASE_FIXTURE(roadside,
                  "what is lost counts as the worst delay, and no more") {
  const auto lodm = make_lodm("alto");
  add(1);
  add(2);
  CHECK(goes_to(ask(*lodm)) == 1);
  runs_at(1);
  auto lost = cycle(true);
  lost.latency_s = std::numeric_limits<double>::infinity();
  lodm->observe(lost);
  lodm->observe(episode_outcome{"any", 1, 1, "qos_gap"});
  runs_at(std::nullopt);
  CHECK(goes_to(ask(*lodm)) == 2);
}

TEST_CASE_FIXTURE(roadside, "who refuses is left alone for a while") {
  for (const auto name : {"ucb1", "alto"}) {
    const auto lodm = make_lodm(name);
    providers.clear();
    add(1);
    add(2);
    if (!goes_to(ask(*lodm))) { // on trial on board
      lodm->observe(cycle());
      pass(2s);
    }
    CHECK(goes_to(ask(*lodm)) == 1);
    lodm->observe(refusal_outcome{seen.now, "any", 1, "no room"});
    CHECK(goes_to(ask(*lodm)) == 2);
  }
}

TEST_CASE_FIXTURE(roadside, "a trial ends where the provider is gone, and the "
                            "same context gives the same decision") {
  for (const auto name : {"ucb1", "alto"}) {
    const auto lodm = make_lodm(name);
    providers.clear();
    add(1);
    if (!goes_to(ask(*lodm))) {
      lodm->observe(cycle());
      pass(2s);
    }
    CHECK(goes_to(ask(*lodm)) == 1);
    CHECK(goes_to(ask(*lodm)) == 1);
    providers[0].id = 2;
    CHECK(goes_to(ask(*lodm)) != 1);
  }
}

TEST_CASE_FIXTURE(follower, "a bandit that is restored goes on alike, a clone "
                            "too") {
  for (const std::string name : {"ucb1", "alto"}) {
    CAPTURE(name);
    const auto lodm = make_lodm(name);
    providers.clear();
    add(1);
    add(2);
    add(3);
    latency_s = {{1, 0.04}, {2, 0.03}, {3, 0.02}};
    drive(*lodm, 100);
    seen.service = "other";
    drive(*lodm, 10);
    seen.service = "any";
    const auto text = lodm->snapshot();
    const auto restored = make_lodm(name);
    CHECK(!restored->restore(text));
    CHECK(restored->snapshot() == text);
    const auto cloned = restored->clone();
    CHECK(cloned->snapshot() == text);
    for (const auto& bad : {std::string{}, text.substr(0, text.size() / 2),
                            text + "more", "x" + text}) {
      CHECK(restored->restore(bad));
      CHECK(restored->snapshot() == text);
    }
    CHECK(goes_to(ask(*cloned)) == goes_to(ask(*restored)));
  }
}

TEST_CASE_FIXTURE(roadside, "what a bandit has learned of a provider with the "
                            "number 0 is refused") {
  const auto lodm = make_lodm("ucb1");
  add(1);
  lodm->observe(cycle());
  REQUIRE(!goes_to(ask(*lodm)));
  auto text = lodm->snapshot();
  const std::string providers = "providers 1 1";
  const auto at = text.find(providers);
  REQUIRE(at != std::string::npos);
  text[at + providers.size() - 1] = '0';
  const auto fault = make_lodm("ucb1")->restore(text);
  REQUIRE(fault);
  CHECK(fault->find("at least 1") != std::string::npos);
}
