// What a report makes of several runs, and of what figures mean.
#include "experiments/report/comparison.hpp"
#include "experiments/report/describe.hpp"
#include "experiments/report/documented.hpp"
#include "experiments/report/options.hpp"
#include "experiments/report/recorded_run.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/experiments/report_sections.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace sofof::experiments::report {

using namespace made_up;

TEST_CASE("meanings are those of the documentation") {
  CHECK(documented("Reasons", "left_area")
        == "the vehicle left the provider's area");
  CHECK(documented("summary.json", "t_off_s.max")
        == "switch to remote → switch back, per episode; without those that "
           "the end of the drive cut off (shutdown on the vehicle's side, "
           "running_at_end), as in the study");
  CHECK(documented("summary.json", "served.time_s.mean")
            .starts_with("running services as the provider closed them"));
  CHECK(documented("summary.json", "v2x.mcm_up.octets").starts_with("ITS"));
  CHECK(documented("Implausible results", "road").starts_with("how far the"));
  CHECK(documented("summary.json", "no_such_figure") == "");
  CHECK(documented("No such section", "plans.count") == "");
}

TEST_CASE("two runs are compared side by side, first what differs") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  other.spoil("config.toml", "seed = 7", "seed = 8");
  other.spoil("summary.json", "\"offers\": ", "\"offers\": 1");
  one.ends_no_episode_early();
  other.ends_no_episode_early();
  const auto sections = compare_runs(one.path(), other.path());
  CHECK(sections[0].title == "What differs");
  CHECK(sections[1].title == "In short");
  CHECK(sections[2].title == "Drives");
  const auto& options = first_of<table>(sections, "What differs");
  REQUIRE(options.rows.size() == 1);
  CHECK(options.rows[0] == std::vector<std::string>{"seed", "7", "8"});
  CHECK(first_of<paragraph>(sections, "What differs").text
        == "The seeds differ: a part of every difference is chance.");
  const auto& key = first_of<table>(sections, "Key figures");
  CHECK(key.columns
        == std::vector<std::string>{"figure", "one", "other", "difference"});
  CHECK(cell(key, "length, s", 3) == "0");
  CHECK(cell(key, "offers", 3).starts_with("+1"));
  CHECK(std::ranges::count(key.verdicts, table::verdict::same)
        == std::ssize(key.rows) - 1);
  CHECK(std::ranges::count_if(sections[2].blocks,
                              [](const auto& block) {
                                return std::holds_alternative<drive>(block);
                              })
        == 2);
  const auto& by_time =
      first_of<figure>(sections, "Remote results of trajectory_planning");
  CHECK(by_time.curves.at(0).name == "one");
  CHECK(by_time.curves.at(1).name == "other");
  const auto whole = describe(std::array{one.path(), other.path()}, "0.1.0");
  CHECK(whole.subtitle.starts_with("Differs in: seed 7 → 8. "));
  CHECK(test::contains(whole.subtitle,
                       " made_up, seed 7, 2 vehicles, 100 s, channel "
                       "paper_sim, sofof 0.1.0 "));
}

TEST_CASE("a difference that would round to zero is shown by its first digit") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  const std::array folders{one.path(), other.path()};
  const comparison both{open_runs(folders)};
  CHECK(both.difference("latency_ms.mean", 1, 1.004, 2) == "+0.004");
  CHECK(both.difference("latency_ms.mean", 1, 0.996, 2) == "-0.004");
  CHECK(both.difference("latency_ms.mean", 1, 1.25, 2) == "+0.25");
  CHECK(both.difference("latency_ms.mean", 0.1 + 0.2, 0.3, 2) == "0");
}

TEST_CASE(
    "what took unlike times is compared per minute, extremes not at all") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  other.spoil("summary.json", "\"virtual_s\": 100", "\"virtual_s\": 50");
  const auto sections = compare_runs(one.path(), other.path());
  CHECK(first_of<paragraph>(sections, "What differs")
            .text.starts_with("`one` lasted 100 s, `other` 50 s: "));
  const auto& run = first_of<table>(sections, "Key figures");
  CHECK(cell(run, "length, s", 3) == "–");
  CHECK(cell(run, "vehicles", 3) == "0");
  for (const auto& one_section : sections)
    if (one_section.title == "Key figures")
      for (const auto& block : one_section.blocks) {
        const auto& t = std::get<table>(block);
        if (t.title != "Offloading of trajectory_planning")
          continue;
        // 3 in 100 s, 3 in 50 s
        CHECK(cell(t, "requests", 1) == cell(t, "requests", 2));
        CHECK(cell(t, "requests", 3).ends_with(" /min"));
        CHECK(cell(t, "latency, mean, ms", 3) == "0");
        CHECK(cell(t, "latency, longest, ms", 3) == "–");
      }
}

TEST_CASE("a comparison tells better from worse where that is clear") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  one.ends_no_episode_early();
  other.ends_no_episode_early();
  const auto runs = open_runs(std::array{one.path(), other.path()});
  const comparison both{runs};
  using enum table::verdict;
  CHECK(both.verdict("latency_ms.mean", 20, 10) == better);
  CHECK(both.verdict("latency_ms.mean", 10, 20) == worse);
  CHECK(both.verdict("offloaded_share", 0.5, 0.6) == better);
  CHECK(both.verdict("driving.min_accel_mps2", -3, -2) == better);
  CHECK(both.verdict("latency_ms.count", 10, 20) == different);
  CHECK(both.difference("driving.max_jerk_mps3", 1, 3, 1) == "+2.0");
}

TEST_CASE("figures of results are not judged where episodes ended early") {
  const played_folder one{"one"};
  const played_folder other{"other"};
  other.ends_no_episode_early();
  const auto runs = open_runs(std::array{one.path(), other.path()});
  const comparison both{runs};
  using enum table::verdict;
  CHECK(both.verdict("latency_ms.mean", 20, 10) == different);
  CHECK(both.verdict("interarrival_ms.max", 20, 10) == different);
  CHECK(both.verdict("offloaded_share", 0.5, 0.6) == better);
  CHECK(
      test::contains(first_of<paragraph>(compare_runs(one.path(), other.path()),
                                         "What differs")
                         .text,
                     "is in no figure of results"));
}

TEST_CASE("options that differ are written as people write them") {
  const std::array<std::string_view, 3> texts{"a = 0.2\nb = 13.89\nc = 1",
                                              "a = 0.2\nb = 1e-28\nc = 1",
                                              "b = 13.89\nc = 1"};
  CHECK(differing_options(texts).rows
        == std::vector<std::vector<std::string>>{
            {"a", "0.2", "0.2", "–"}, {"b", "13.89", "1e-28", "13.89"}});
}

TEST_CASE("a run is not compared with itself") {
  const played_folder one{"one"};
  const auto again = one.path() / ".." / "one";
  CHECK_THROWS_WITH_AS(open_runs(std::array{one.path(), again}),
                       doctest::Contains("are one folder"), input_error);
}

TEST_CASE("of more than two runs the key figures come first, then each run") {
  const played_folder one{"a"};
  const played_folder two{"b"};
  const played_folder three{"c"};
  const std::array folders{one.path(), two.path(), three.path()};
  const auto whole = describe(folders, "0.1.0");
  CHECK(whole.title == "a · b · c");
  CHECK(whole.sections.front().title == "What differs");
  CHECK(
      first_of<figure>(whole.sections, "Remote results of trajectory_planning")
          .curves.size()
      == 3);
  CHECK(first_of<table>(whole.sections, "Key figures").columns
        == std::vector<std::string>{"figure", "a", "b", "c"});
  CHECK(first_of<drive>(whole.sections, "c: Drive").folder == three.path());
}

} // namespace sofof::experiments::report
