// The story of an episode, from the files of a made-up run.
#include "base/input_error.hpp"
#include "base/random.hpp"
#include "experiments/explain/cause.hpp"
#include "experiments/explain/story.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::experiments::explain;
using test::contains;
using test::scratch;
using test::write_text;

namespace {

/// Two episodes of 101 at mec: one is planned, one ends early.
struct told_run {
  scratch folder;
  std::string reason = "qos_latency";
  std::string because = "qos_latency value_ms=61.200000 limit_ms=50.000000";
  std::string provider_closed = "30.010000000";
  std::string last = "61.2,130.0,1,,0.0,5.0,63.8,40.0,3.2,0.0,18.0";

  std::string told(const question& q = {}) const {
    write_text(folder / "summary.json", "{}\n");
    write_text(
        folder / "episodes.csv",
        "side,station,provider,provider_id,service,counter,accepted_s,"
        "first_data_s,ended_s,t_off_s,reason,fallback,because\n"
        "requester,101,mec,1,planning,1,1.0,1.1,11.0,9.9,left_area,0,told\n"
        "requester,101,mec,1,planning,2,20.0,20.1,30.0,9.9,"
            + reason + ",1," + because
            + "\nprovider,101,mec,1,planning,2,20.0,," + provider_closed + ",,"
            + reason + ",0,told by the vehicle\n");
    write_text(
        folder / "events.jsonl",
        R"({"t_s":19.9,"what":"offer","station":101,"provider":"mec",)"
        R"("provider_id":1,"service":"","counter":0,"detail":""})"
        "\n"
        R"({"t_s":20.0,"what":"accepted","station":101,"provider":"mec",)"
        R"("provider_id":1,"service":"planning","counter":2,"detail":"room"})"
        "\n");
    std::string rows =
        "station,provider,provider_id,service,counter,cycle,received_s,"
        "latency_ms,input_age_ms,used,interarrival_ms,uplink_wait_ms,uplink_ms,"
        "rest_ms,"
        "queue_ms,computing_ms,downlink_wait_ms,downlink_ms\n";
    for (int k = 0; k < 20; ++k)
      rows += "101,mec,1,planning,2," + std::to_string(400 + k)
              + ",21.0,12.0,70.0,1,50.0,0.0,5.0,53.0,0.5,3.0,0.0,8.5\n";
    rows += "101,mec,1,planning,2,420,30.0," + last + '\n';
    write_text(folder / "cycles.csv", rows);
    write_text(folder / "load.csv",
               "t_s,provider,what,jobs,asked_share,busy_share,mean_wait_ms\n"
               "29,mec,workers,200,1.12,1.0,30.0\n"
               "30,mec,workers,100,0.40,0.4,10.0\n"
               "30,mec,uplink,100,0.02,0.02,0.0\n");
    return tell(folder.path(), q);
  }
};

/// Without its breaks of lines.
std::string unwrapped(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

} // namespace

TEST_CASE("a story goes from the offer to why it ended, in the order of time") {
  const told_run run;
  CHECK(run.told()
        == "Station 101, planning at mec: 20.000 to 30.000 s, ended early\n"
           "(the only one of 2 episodes that ended early)\n"
           "    19.900 s  offer of mec\n"
           "    20.000 s  accepted: room\n"
           "    20.100 s  the first result in time: it is used from now on\n"
           "              21 results came, 21 used\n"
           "              latency mean 14.3, at most 61.2 ms\n"
           "              age of the input mean 72.9, at most 130.0 ms\n"
           "    30.000 s  the last result: latency 61.2 ms, input 130.0 ms "
           "old\n"
           "              of the latency: wait for a worker 40.0, way down "
           "18.0, computing 3.2 ms\n"
           "    30.000 s  ended: qos_latency (61.2 ms, limit 50.0 ms)\n"
           "              asked of mec just then: uplink 2 %, workers 112 %\n"
           "              the vehicle's own function took over (a fallback)\n"
           "    30.010 s  mec closed it: qos_latency (told by the vehicle)\n"
           "Why: it was too late: the wait for a worker took 40.0 ms, 0.5 as a "
           "rule; the\nworkers were asked for 112 % just then.\n");
}

TEST_CASE("the episode that is told of is the one at a time, or the first that "
          "ended early") {
  const told_run run;
  CHECK(contains(run.told({101, 5.0, ""}), "1.000 to 11.000 s"));
  CHECK(contains(run.told({101, 14.0, ""}), "1.000 to 11.000 s"));
  CHECK(contains(run.told({101, 19.0, ""}), "20.000 to 30.000 s"));
  CHECK(contains(run.told({{}, {}, "planning"}), "20.000 to 30.000 s"));
}

TEST_CASE("where no episode ran at a time, the nearest is called so") {
  const told_run run;
  CHECK(run.told({101, 14.5, ""})
            .starts_with("No episode ran at 14.5 s. The nearest episode:\n"
                         "Station 101, planning at mec: 1.000 to 11.000 s"));
  CHECK(run.told({101, 5.0, ""}).starts_with("Station 101"));
}

TEST_CASE("where no episode ran at a time, a refusal near it is told") {
  const told_run run;
  run.told();
  const auto refused = [](const char* t_s, const char* station) {
    return std::string{R"({"t_s":)"} + t_s + R"(,"what":"refused","station":)"
           + station
           + R"(,"provider":"mec","provider_id":1,"service":"planning",)"
             R"("counter":0,"detail":"outside the area"})"
             "\n";
  };
  write_text(run.folder / "events.jsonl", refused("12.9", "101")
                                              + refused("14.25", "101")
                                              + refused("14.5", "102"));
  CHECK(unwrapped(tell(run.folder.path(), {101, 14.5, ""}))
            .starts_with("No episode ran at 14.5 s; at 14.250 s planning of "
                         "station 101 was refused by mec: outside the area. "
                         "The nearest episode: Station 101"));
}

TEST_CASE("a time outside the run is refused") {
  const told_run run;
  run.told();
  write_text(run.folder / "summary.json", "{\"virtual_s\": 40}\n");
  const auto told_at = [&run](double at_s) {
    return tell(run.folder.path(), {{}, at_s, ""});
  };
  CHECK_THROWS_WITH_AS(told_at(-1), "--at -1: a run begins at 0 s.",
                       input_error);
  CHECK_THROWS_WITH_AS(told_at(40.5), doctest::Contains("ended at 40 s"),
                       input_error);
  CHECK_THROWS_AS(told_at(std::nan("")), input_error);
  CHECK(contains(told_at(39), "No episode ran at 39 s"));
  write_text(run.folder / "summary.json", "{}\n"); // it was killed
  CHECK_THROWS_AS(told_at(1e9), input_error);
}

TEST_CASE("an episode that the run's end cut off did not end as planned") {
  told_run run;
  run.reason = "shutdown";
  CHECK(contains(run.told({101, 25.0, ""}), "30.000 s, ended as planned"));
  CHECK(contains(run.told({101, 25.0, ""}), "Why: the vehicle had arrived"));
  write_text(run.folder / "summary.json", "{\"virtual_s\": 30}\n");
  const auto cut = tell(run.folder.path(), {101, 25.0, ""});
  CHECK(contains(cut, "30.000 s, cut off"));
  CHECK(contains(cut, "Why: the run ended."));
}

TEST_CASE("a time is told of one service, and how to ask for another") {
  const told_run run;
  run.told();
  const auto file = run.folder / "episodes.csv";
  write_text(file, test::read_file(file)
                       + "requester,101,mec,1,climate,1,20.0,20.1,31.0,10.9,"
                         "left_area,0,told\n");
  const auto told = tell(run.folder.path(), {101, 25.0, ""});
  CHECK(contains(told, "(one of 3 episodes of 2 services; 1 ended early)\n"
                       "(--service climate tells of that one then)\n"));
}

TEST_CASE("one sentence says that there is no such vehicle or service") {
  const told_run run;
  CHECK_THROWS_WITH_AS(run.told({102, {}, ""}),
                       doctest::Contains("this run has no station 102"),
                       input_error);
  CHECK_THROWS_WITH_AS(run.told({{}, {}, "climate"}),
                       doctest::Contains("no service climate"), input_error);
  const scratch empty;
  CHECK_THROWS_WITH_AS(tell(empty.path(), {}),
                       doctest::Contains("is no results folder"), input_error);
}

namespace {

/// A run of 101 and 102 in which nothing was offloaded.
struct idle_run {
  scratch folder;

  explicit idle_run(const std::string& events, const std::string& side = "") {
    write_text(
        folder / "summary.json",
        R"({"headline":{"offloading":"Never offloaded: nobody offered it."},)"
        R"("services":{"climate":{"requests":0}}})");
    write_text(folder / "episodes.csv",
               "side,station,provider,provider_id,service,counter,accepted_s,"
               "first_data_s,ended_s,t_off_s,reason,fallback,because\n"
                   + side);
    write_text(folder / "vehicles.csv", "station\n101\n102\n");
    write_text(folder / "events.jsonl", events);
  }
  static std::string event(const std::string& what, const std::string& detail) {
    return R"({"t_s":1.0,"what":")" + what
           + R"(","station":101,"provider":"mec","provider_id":1,"service":)"
             R"("planning","counter":0,"detail":")"
           + detail + "\"}\n";
  }
  std::string told(const question& q = {}) const {
    return tell(folder.path(), q);
  }
};

} // namespace

TEST_CASE("a run without episodes is told by its headline") {
  const idle_run run{""};
  CHECK(run.told() == "Never offloaded: nobody offered it.\n");
}

TEST_CASE("a vehicle or a service without episodes is told why") {
  const idle_run quiet{""};
  CHECK(contains(quiet.told({102, {}, ""}),
                 "Station 102: never offloaded: nobody offered it."));
  CHECK(contains(quiet.told({{}, {}, "climate"}), "climate: never offloaded"));
  CHECK_THROWS_AS(quiet.told({103, {}, ""}), input_error);
  const idle_run refused{
      idle_run::event("offer", "planning")
      + idle_run::event("stay_local", "too short value=1.0 limit=2.0")
      + idle_run::event("refused", "no room value=0.9 limit=0.8")
      + idle_run::event("refused", "no room value=1.1 limit=0.8")};
  CHECK(contains(refused.told({101, {}, "planning"}),
                 "Station 101, planning: never offloaded: 2 requests, none "
                 "accepted; most often (2\ntimes): no room."));
  CHECK(contains(refused.told({102, {}, ""}), "nobody offered it"));
  CHECK(
      unwrapped(refused.told({101, 1.0, ""}))
          .starts_with("No episode ran at 1 s; at 1.000 s planning of station "
                       "101 stayed in the vehicle: too short value=1.0 "
                       "limit=2.0. Station 101: "
                       "never offloaded"));
  CHECK_THROWS_AS(refused.told({101, 500.0, ""}), input_error);
  // An offer of other services is none of this one; of older versions no offer
  // tells.
  const idle_run other{idle_run::event("offer", "climate")};
  CHECK(contains(other.told({101, {}, "planning"}), "nobody offered it"));
  CHECK(contains(other.told({101, {}, ""}), "asked for nothing"));
  const idle_run older{idle_run::event("offer", "")};
  CHECK(contains(older.told({101, {}, ""}), "asked for nothing"));
}

TEST_CASE("a folder of a provider is not one to explain") {
  const idle_run run{"", "provider,101,mec,1,planning,1,1.0,,2.0,,left_area,0,"
                         "\n"};
  CHECK_THROWS_WITH_AS(run.told(), doctest::Contains("`sofof drive`"),
                       input_error);
}

TEST_CASE("each reason has a why of its own") {
  struct told {
    std::string reason, because, why;
  };
  const std::vector<told> all{
      {"qos_gap", "qos_gap value_ms=100.000001 limit_ms=100.000000",
       "nothing came: results were lost, or held back"},
      {"qos_input_age", "qos_input_age value_ms=130.0 limit_ms=100.0",
       "the input was too old: the wait for a worker took 40.0 ms"},
      {"released", "", "the vehicle gave it back."},
      {"refused", "", "refused to go on"},
      {"handed_over", "to provider_id 2", "another provider had taken over"},
      {"cam_timeout", "told by the provider", "heard nothing of the vehicle"},
      {"peer_lost", "", "mec is gone"},
      {"implausible", "road value=0.312 limit=0.250",
       "failed the vehicle's check: road value=0.312"},
      {"revoked", "told by the provider", "took its room back"},
      {"no_data", "no_data value_ms=1000.0 limit_ms=1000.0", "none in time"},
  };
  for (const auto& x : all) {
    CAPTURE(x.reason);
    told_run run;
    run.reason = x.reason;
    run.because = x.because;
    const auto told = run.told({101, 25.0, ""});
    CHECK(contains(told, "Why: "));
    CHECK(contains(told, x.why));
  }
}

TEST_CASE("silence is told apart by what the link did to the vehicle's "
          "results") {
  told_run run;
  run.reason = "qos_gap"; // at 30 s
  write_text(run.folder / "octets.csv",
             "t_s,provider,direction,what,messages,sent,delivered,lost,"
             "under_way\n29,mec,down,planning,100,1000,900,50,0\n");
  CHECK(contains(run.told({101, 25.0, ""}), "were lost, or held back"));
  const auto told_with = [&run](const std::string& line) {
    write_text(run.folder / "disturbed.csv",
               "t_s,provider,direction,station,what,lost,outage,stall,slow\n"
                   + line + '\n');
    return unwrapped(run.told({101, 25.0, ""}));
  };
  CHECK(contains(told_with("29.990,mec,down,101,planning,3,1,2,0"),
                 "results get lost: 5.0 % of what mec sent"));
  CHECK(contains(told_with("30.000,mec,down,101,planning,1,3,2,0"),
                 "lost in an outage"));
  CHECK(contains(told_with("29.990,mec,down,101,planning,1,0,2,0"),
                 "the connection stalled"));
  CHECK(contains(told_with("29.990,mec,down,101,planning,0,0,1,2"),
                 "the network's own delay held back what was due, by 50 ms"));
  for (const auto* other : {"29.981,mec,down,101,planning,9,0,0,0",
                            "30.001,mec,down,101,planning,9,0,0,0",
                            "29.990,far,down,101,planning,9,0,0,0",
                            "29.990,mec,up,101,planning,9,0,0,0",
                            "29.990,mec,down,102,planning,9,0,0,0",
                            "29.990,mec,down,101,CAM,9,0,0,0"})
    CHECK(contains(told_with(other), "sent none, or it waited; the workers"));
  for (const auto* broken : {"29.990,mec,sideways,101,planning,9,0,0,0",
                             "1e300,mec,down,101,planning,9,0,0,0",
                             "29.990,mec,down,4294967397,planning,9,0,0,0"})
    CHECK_THROWS_WITH_AS(told_with(broken),
                         doctest::Contains("disturbed.csv:2"), input_error);
}

TEST_CASE(
    "what disturbed results is read of runs that did not tell slow ones") {
  told_run run;
  run.reason = "qos_gap"; // at 30 s
  write_text(run.folder / "octets.csv",
             "t_s,provider,direction,what,messages,sent,delivered,lost,"
             "under_way\n29,mec,down,planning,100,1000,900,50,0\n");
  write_text(run.folder / "disturbed.csv",
             "t_s,provider,direction,station,what,lost,outage,stall\n"
             "29.990,mec,down,101,planning,1,0,2\n");
  CHECK(contains(run.told({101, 25.0, ""}), "the connection stalled"));
  write_text(run.folder / "disturbed.csv",
             "t_s,provider,direction,station,what,lost,outage,stall\n"
             "10.000,mec,down,101,planning,1,0,2\n");
  CHECK(contains(unwrapped(run.told({101, 25.0, ""})),
                 "nothing came: results were lost, or held back"));
}

TEST_CASE("the parts of an age add up: the smallest of them are together") {
  CHECK(in_parts({.uplink = 20, .rest = 50, .queue = 3, .downlink = 30}, true)
        == "wait for the cycle 50.0, way down 30.0, way up 20.0, other 3.0");
}

TEST_CASE("the parts of an age add up as printed, whatever is rounded") {
  const random_stream noise{1, "parts"};
  for (std::uint64_t n = 0; n < 1000; ++n) {
    report::time_parts x;
    double all = 0;
    std::uint64_t k = 0;
    for (auto* of : {&x.uplink_wait, &x.uplink, &x.rest, &x.queue, &x.computing,
                     &x.downlink_wait, &x.downlink}) {
      all += * of = noise.exponential(k % 2 == 0 ? 0.04 : 5, 10 * n + k);
      ++k;
    }
    const auto text = in_parts(x, true);
    double sum = 0;
    for (auto at = text.find_first_of("0123456789"); at != text.npos;
         at = text.find_first_of("0123456789", text.find(',', at)))
      sum += std::stod(text.substr(at));
    REQUIRE(sum == doctest::Approx(std::round(10 * all) / 10));
  }
  CHECK(in_parts({.uplink = 0.01, .queue = 0.04}, true).empty());
}

TEST_CASE("a latency that counts from its input has all parts") {
  told_run run;
  run.last = "130.0,130.0,1,,0.0,70.0,10.0,20.0,20.0,0.0,10.0";
  CHECK(contains(run.told(), "it was too late: the way up took 70.0 ms"));
}

TEST_CASE(
    "a provider that had closed a session before is why results stopped") {
  told_run run;
  run.reason = "qos_gap";
  run.provider_closed = "29.900000000";
  CHECK(contains(run.told(), "mec had closed it 0.100 s before"));
}

TEST_CASE("the part that took half of the time is the cause, else the one that "
          "took most more than usual") {
  std::vector<experiments::report::cycle_line> results(5);
  for (auto& x : results)
    x.parts = experiments::report::time_parts{
        .queue = 1, .computing = 10, .downlink = 12};
  results.back().parts = experiments::report::time_parts{
      .queue = 20, .computing = 12, .downlink = 25};
  CHECK(longest_part(results, false).what == "wait for a worker");
  results.back().parts = experiments::report::time_parts{
      .queue = 20, .computing = 12, .downlink = 45};
  CHECK(longest_part(results, false).what == "way down");
  results.back().parts->uplink_wait = 500;
  CHECK(longest_part(results, false).what == "way down");
  CHECK(longest_part(results, true).what == "wait for the uplink");
}
