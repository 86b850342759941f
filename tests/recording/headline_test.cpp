// A run in three sentences.
#include "recording/headline.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::recording;
using namespace std::chrono_literals;

namespace {

const provider_id junction = 1, east = 2;

/// A run of 100 s with one vehicle and two providers.
struct told_run {
  run_info info;
  run_end end{100, 1, false};
  metrics figures{described()};

  run_info described() {
    info.vehicles = 1;
    info.provider_names = {{junction, "junction"}, {east, "east"}};
    info.services = {"trajectory_planning"};
    return info;
  }
  void offer(const std::string& services = "trajectory_planning") {
    figures.on_record(
        event_record{.what = event_type::offer, .detail = services});
  }
  void decide(bool accepted, const std::string& why = {}) {
    figures.on_record(
        decision_record{{}, 101, "trajectory_planning", accepted});
    if (!accepted)
      figures.on_record(event_record{.what = event_type::refused,
                                     .service = "trajectory_planning",
                                     .detail = why});
  }
  void episode(provider_id at, end_reason reason, bool got_data = true,
               const char* service = "trajectory_planning") {
    figures.on_record(episode_record{.session = {at, 101, service, 1},
                                     .first_data = time_point{10s},
                                     .got_data = got_data,
                                     .ended = time_point{20s},
                                     .reason = reason});
  }
  /// One that came before the end, and where its time went.
  void result(provider_id at, const result_timing& timing) {
    figures.on_record(
        cycle_record{.session = {at, 101, "trajectory_planning", 1},
                     .created = time_point{19'800ms},
                     .received = time_point{19'900ms},
                     .timing = timing});
  }
  void drive() {
    figures.on_record(safety_record{.station = 101, .driven = 100s});
  }
  void tell(const disturbed_messages& x) {
    figures.add(std::span{&x, 1}, time_point{30s});
  }
  headline said() { return headline_of(figures, info, end); }
};

} // namespace

TEST_CASE("a headline says how much was offloaded, and that nothing ended "
          "early") {
  told_run run;
  run.offer();
  run.drive();
  run.decide(true);
  run.decide(true);
  run.episode(junction, end_reason::left_area);
  CHECK(run.said().offloading
        == "Offloaded 10.0 % of the time; the one episode did not end early.");
  run.episode(junction, end_reason::handed_over);
  CHECK(run.said().offloading
        == "Offloaded 20.0 % of the time; none of 2 episodes ended early.");
}

TEST_CASE("of early ends of one reason the headline names the providers, most "
          "often first") {
  told_run run;
  run.offer();
  run.drive();
  run.episode(east, end_reason::qos_latency);
  run.episode(junction, end_reason::qos_latency);
  run.episode(junction, end_reason::qos_latency);
  run.episode(junction, end_reason::left_area);
  CHECK(run.said().offloading
        == "Offloaded 40.0 % of the time; 3 of 4 episodes ended early, all by "
           "latency (junction 2, east 1).");
}

TEST_CASE("of early ends of several reasons the headline counts each") {
  told_run run;
  run.offer();
  run.drive();
  run.episode(east, end_reason::revoked);
  run.episode(junction, end_reason::qos_gap);
  run.episode(junction, end_reason::qos_gap);
  CHECK(run.said().offloading
        == "Offloaded 30.0 % of the time; 3 of 3 episodes ended early: 2 by "
           "gaps between results (junction 2), 1 by revocation (east 1).");
}

TEST_CASE("of gaps between results the headline names what made them, by what "
          "the link did to this vehicle's results") {
  const auto disturbed = [](channel::disturbed_line line) {
    told_run run;
    run.offer();
    run.drive();
    run.result(junction, {.down = {0ms, 20ms}}); // sent at 19.88 s
    run.episode(junction, end_reason::qos_gap);  // ends at 20 s
    run.tell({"junction", "down", line});
    return run.said().offloading;
  };
  const auto said = [](std::string_view cause) {
    return fmt::format("Offloaded 10.0 % of the time; 1 of 1 episode ended "
                       "early, that by {} (junction 1).",
                       cause);
  };
  const std::string planning = "trajectory_planning";
  CHECK(disturbed({20s, 101, planning, {3, 1, 2}})
        == said("gaps, as results were lost"));
  CHECK(disturbed({19'881ms, 101, planning, {0, 3, 2}})
        == said("gaps in outages"));
  CHECK(disturbed({19'881ms, 101, planning, {0, 0, 2}})
        == said("gaps, as stalls held results back"));
  for (const auto& other :
       {channel::disturbed_line{19'880ms, 101, planning, {9, 0, 0}},
        channel::disturbed_line{20'001ms, 101, planning, {9, 0, 0}},
        channel::disturbed_line{20s, 102, planning, {9, 0, 0}},
        channel::disturbed_line{20s, 101, "CAM", {9, 0, 0}}})
    CHECK(disturbed(other) == said("gaps between results"));
}

TEST_CASE(
    "a result that was lost long after the next one was due made no gap") {
  const auto lost_at = [](duration at) {
    told_run run;
    run.offer();
    run.drive();
    run.result(junction, {.down = {0ms, 50ms}}); // sent at 19.85 s
    run.result(junction, {.down = {0ms, 20ms}}); // and at 19.88 s
    run.episode(junction, end_reason::qos_gap);  // ends at 20 s
    run.tell({"junction", "down", {at, 101, "trajectory_planning", {1, 0, 0}}});
    return run.said().offloading.find("as results were lost")
           != std::string::npos;
  };
  CHECK(lost_at(19'970ms));
  CHECK_FALSE(lost_at(19'971ms));
}

TEST_CASE("of results that were too late the headline names what took half of "
          "their time or more") {
  const auto said = [](end_reason reason, const result_timing& timing) {
    told_run run;
    run.offer();
    run.drive();
    run.result(junction, timing);
    run.episode(junction, reason);
    return run.said().offloading;
  };
  const auto text = [](std::string_view cause) {
    return fmt::format("Offloaded 10.0 % of the time; 1 of 1 episode ended "
                       "early, that by {} (junction 1).",
                       cause);
  };
  const result_timing computed{
      .up = {0ms, 60ms}, .queue = 5ms, .computing = 20ms, .down = {1ms, 14ms}};
  CHECK(said(end_reason::qos_latency, computed)
        == text("latency, mostly the computing"));
  CHECK(said(end_reason::qos_latency,
             {.queue = 15ms, .computing = 3ms, .down = {5ms, 14ms}})
        == text("latency"));
  auto of_its_input = computed; // its latency counts from there
  of_its_input.input_at = time_point{19'800ms};
  CHECK(said(end_reason::qos_latency, of_its_input)
        == text("latency, mostly the way up"));
  auto old = computed; // made 100 ms before it was received
  old.input_at = time_point{19'800ms};
  CHECK(said(end_reason::qos_input_age, old)
        == text("the age of inputs, mostly the way up"));
}

TEST_CASE("what nobody drove has no share of time") {
  told_run run;
  run.offer();
  run.episode(junction, end_reason::left_area);
  CHECK(run.said().offloading
        == "Offloaded, for what share of the driving is not known; the one "
           "episode did not end early.");
}

TEST_CASE("of several services the headline names the one that it is about, "
          "and others that did not go well") {
  told_run run;
  run.info.services.emplace_back("cabin_climate");
  run.figures = metrics{run.info};
  CHECK(run.said().offloading
        == "Never offloaded trajectory_planning: nobody offered it. Never "
           "offloaded cabin_climate: nobody offered it.");
  run.drive();
  run.offer("cabin_climate");
  run.episode(junction, end_reason::left_area, true, "cabin_climate");
  CHECK(run.said().offloading
        == "Never offloaded trajectory_planning: nobody offered it.");
  run.offer();
  run.episode(junction, end_reason::left_area);
  CHECK(run.said().offloading
        == "Offloaded trajectory_planning 10.0 % of the time; the one episode "
           "did not end early.");
  run.episode(junction, end_reason::qos_input_age, true, "cabin_climate");
  CHECK(run.said().offloading
        == "Offloaded trajectory_planning 10.0 % of the time; the one episode "
           "did not end early. Offloaded cabin_climate 20.0 % of the time; 1 "
           "of 2 episodes ended early, that by the age of inputs (junction "
           "1).");
}

TEST_CASE("every early end has words of its own") {
  std::vector<std::string> all;
  for (int k = 0; k <= static_cast<int>(end_reason::shutdown); ++k) {
    const auto reason = static_cast<end_reason>(k);
    if (is_planned(reason))
      continue;
    told_run run;
    run.offer();
    run.episode(junction, reason);
    all.push_back(run.said().offloading);
    CHECK_MESSAGE(all.back().find('_') == std::string::npos, all.back());
  }
  CHECK(all.size() == 9);
  std::ranges::sort(all);
  CHECK(std::ranges::unique(all).empty());
}

TEST_CASE("where nothing was offloaded the headline says why") {
  told_run none;
  CHECK(none.said().offloading == "Never offloaded: nobody offered it.");
  told_run unwanted;
  unwanted.offer();
  unwanted.figures.on_record(event_record{.what = event_type::stay_local,
                                          .service = "trajectory_planning",
                                          .detail = "never"});
  CHECK(unwanted.said().offloading
        == "Never offloaded: the LODM asked for nothing; most often (1 time): "
           "never.");
  told_run refused;
  refused.offer();
  refused.decide(false, "no room value=0.900 limit=0.800");
  refused.decide(false, "no room value=1.000 limit=0.800");
  refused.decide(false, "not in the area");
  CHECK(refused.said().offloading
        == "Never offloaded: 3 requests, none accepted; most often (2 times): "
           "no room.");
  told_run silent;
  silent.offer();
  silent.decide(true);
  silent.episode(junction, end_reason::no_data, false);
  CHECK(silent.said().offloading
        == "Never offloaded: accepted 1 time, but no result came in time.");
}

TEST_CASE("a headline says what was not safe, and near misses apart") {
  told_run run;
  run.drive();
  run.figures.on_record(event_record{.what = event_type::near_miss});
  CHECK(run.said().safety
        == "Safe: always a fresh plan, never off the road, no collision; 1 "
           "near miss.");
  run.figures.on_record(
      safety_record{.station = 101, .driven = 1s, .without_fresh_plan = 400ms});
  run.figures.on_record(collision_record{{}, 101, 102});
  CHECK(run.said().safety
        == "NOT SAFE: 0.400 s without a fresh plan, 0.000 s off the road, 1 "
           "collision; 1 near miss.");
}

TEST_CASE("a headline says when a thread with nothing to do was late") {
  told_run run;
  run.drive();
  run.end.stood_still = {.together = 99ms, .longest = 50ms};
  CHECK(run.said().safety.ends_with("0 near misses."));
  run.end.stood_still = {
      .together = 600ms, .longest = 400ms, .longest_at = 42s};
  CHECK(run.said().safety.ends_with(
      " The machine kept a thread waiting that only looks at the clock: "
      "0.600 s in all, 0.400 s at once until 42 s after the start; "
      "plans may have been late, too."));
}

TEST_CASE("what nobody measured is not said to be empty") {
  told_run run;
  run.info.clock = "virtual";
  CHECK(run.said().load
        == "Nothing could be full: no computing and no airtime took time.");
  run.info.clock = "wall";
  CHECK(run.said().load == "What was full is not known in this process.");
}

TEST_CASE("a headline names what was full") {
  told_run run;
  channel::load_meter meter{1, {}};
  for (int k = 0; k < 100; ++k)
    meter.add(time_point{k * 1s}, 0ms, 10ms);
  run.figures.add(load_table{{{"junction", "uplink", meter.read()}}, {}});
  CHECK(run.said().load
        == "No worker and no cell was asked for more than 90 %.");
  for (int k = 0; k < 10; ++k)
    meter.add(time_point{50s}, 0ms, 100ms);
  run.figures.add(load_table{{{"junction", "uplink", meter.read()}}, {}});
  CHECK(run.said().load
        == "Over 90 % asked of junction uplink (202 % at most, for 0.5 s).");
}
