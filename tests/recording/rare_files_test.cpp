// Files that a run has only if something happened that belongs there.
#include "recording/results.hpp"
#include "tests/recording/folder_checks.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

namespace sofof::made_up {

using namespace messages;
using namespace recording;

namespace fs = std::filesystem;
using test::scratch;

TEST_CASE("how late a vehicle may respond is a line of scene.csv, which is "
          "absent where nobody asks") {
  const scratch dir;
  {
    results r{dir.path(), run()};
    r.on_record(scene_record{at(5s), 101, planning, 720ms, "follow", 85ms});
    r.on_record(scene_record{at(6s), 101, planning, 5s, "free", std::nullopt});
    r.finish(at(100s), 2, false);
  }
  CHECK(content_of(dir / "scene.csv")
        == "t_s,station,service,safe_ms,because,response_ms\n"
           "5.000000000,101,trajectory_planning,720.000000,follow,85.000000\n"
           "6.000000000,101,trajectory_planning,5000.000000,free,\n");
  results later{dir.path(), run()};
  later.finish(at(100s), 2, false);
  CHECK_FALSE(fs::exists(dir / "scene.csv"));
}

TEST_CASE(
    "claims of crossings are lines of claims.csv, which is absent without "
    "any") {
  const scratch dir;
  {
    results r{dir.path(), run()};
    r.on_record(
        claim_record{101, "in_e", at(5s), at(5200ms), at(9s), at(12s), true});
    r.on_record(
        claim_record{102, "in_n", at(6s), std::nullopt, at(10s), at(13s)});
    r.finish(at(100s), 2, false);
  }
  CHECK(content_of(dir / "claims.csv")
        == "station,lane,claimed_s,bound_s,enters_s,leaves_s,kept\n"
           "101,in_e,5.000000000,5.200000000,9.000000000,12.000000000,1\n"
           "102,in_n,6.000000000,,10.000000000,13.000000000,0\n");
  results later{dir.path(), run()};
  later.finish(at(100s), 2, false);
  CHECK_FALSE(fs::exists(dir / "claims.csv"));
}

TEST_CASE("plans are points of plans.csv, a plan of each fifth of a second, if "
          "they are wanted") {
  const scratch dir;
  auto with_plans = run();
  with_plans.plans = true;
  const auto plan = std::make_shared<world::trajectory>();
  plan->start = at(5s);
  for (int i = 0; i <= 10; ++i)
    plan->points.push_back(
        {.t_s = 0.1 * i, .at = {8 * 0.1 * i, 1}, .speed_mps = 8});
  {
    results r{dir.path(), with_plans};
    track_record x;
    x.ego.own.station = 101;
    r.on_record(x); // without a plan
    x.plan = plan;
    for (const auto ms : {0, 100, 250, 350}) {
      x.at = at(5s + std::chrono::milliseconds{ms});
      r.on_record(x);
    }
    r.finish(at(100s), 2, false);
  }
  CHECK(content_of(dir / "plans.csv")
        == "t_s,station,ahead_s,x_m,y_m,speed_mps\n"
           "5.000000000,101,0.000000000,0.000,1.000,8.000\n"
           "5.000000000,101,0.500000000,4.000,1.000,8.000\n"
           "5.000000000,101,1.000000000,8.000,1.000,8.000\n"
           "5.250000000,101,0.000000000,2.000,1.000,8.000\n"
           "5.250000000,101,0.500000000,6.000,1.000,8.000\n");
  results later{dir.path(), run()};
  later.finish(at(100s), 2, false);
  CHECK_FALSE(fs::exists(dir / "plans.csv"));
}

} // namespace sofof::made_up
