// The files of a run: what is in them, and that nothing is lost.
#include "recording/results.hpp"

#include "base/text/json.hpp"
#include "tests/recording/folder_checks.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace sofof::made_up {

using namespace messages;
using namespace recording;

namespace fs = std::filesystem;
using test::contains;
using test::scratch;

namespace {

std::vector<std::string> lines(const fs::path& path) {
  std::ifstream in{path};
  std::vector<std::string> all;
  for (std::string line; std::getline(in, line);)
    all.push_back(line);
  return all;
}

nlohmann::ordered_json summary_in(const fs::path& folder) {
  return nlohmann::ordered_json::parse(content_of(folder / "summary.json"));
}

track_record track() {
  track_record x;
  x.at = at(1500ms);
  x.ego.own = {101, at(1500ms), {571656.1234, 5364810.5}, -1.5, 8.25, -0.0001};
  x.ego.s_m = 12;
  x.lateral_m = -0.0625;
  x.plan_age = 73ms;
  x.remote = true;
  return x;
}

} // namespace

TEST_CASE("a run leaves all its files, and no temporary one") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.finish(at(100s), 2, false);
  CHECK(names_in(dir.path())
        == std::vector<std::string>{
            "config.toml", "cycles.csv", "distributions.csv", "disturbed.csv",
            "energy.csv", "episodes.csv", "events.jsonl", "load.csv",
            "octets.csv", "summary.json", "timing.csv", "tracks.csv",
            "vehicles.csv"});
  CHECK(content_of(dir / "config.toml") == "seed = 7\n");
}

TEST_CASE("cycles and tracks are written only when wanted") {
  const scratch dir;
  auto info = run();
  info.cycles = info.tracks = false;
  results r{dir.path(), info};
  play(r);
  r.on_record(track());
  r.finish(at(100s), 2, false);
  CHECK_FALSE(fs::exists(dir / "cycles.csv"));
  CHECK_FALSE(fs::exists(dir / "tracks.csv"));
  CHECK(summary_in(dir.path())["latency_ms"]["count"] == 401);
}

TEST_CASE("margins are written when wanted, the least ones in the summary") {
  const scratch dir;
  auto info = run();
  info.margins = true;
  results r{dir.path(), info};
  auto one = result(running(), 3, 60s, 10ms, std::nullopt);
  one.margins = {{"road_m", 0.75}, {"standing_s", 1.2}};
  r.on_record(one);
  one.cycle = 4;
  one.margins = {{"road_m", -0.0125}};
  r.on_record(one);
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "margins.csv");
  REQUIRE(all.size() == 4);
  CHECK(all[0]
        == "station,provider,provider_id,service,counter,cycle,received_s,"
           "margin,left");
  CHECK(all[3]
        == "101,mec,18000000000000000000,trajectory_planning,1,4,"
           "60.010000000,road_m,-0.0125");
  const auto margin =
      summary_in(dir.path())["services"]["trajectory_planning"]["margin"];
  CHECK(margin["road_m"] == -0.0125);
  CHECK(margin["standing_s"] == 1.2);
}

TEST_CASE("disturbed.csv has a line for each moment and vehicle that was "
          "disturbed, while the run goes on") {
  const scratch dir;
  results r{dir.path(), run()};
  const disturbed_messages stalled{
      "mec", "up", {999ms, 101, "one", {0, 0, 1, 0, 0, 2}}};
  const disturbed_messages lost{"mec", "down", {2s, 102, "CAM", {1, 1, 0, 3}}};
  r.add_disturbed(std::span{&stalled, 1}, at(1s));
  r.flush();
  CHECK(lines(dir / "disturbed.csv").size() == 2);
  r.add_disturbed(std::span{&lost, 1}, at(100s));
  r.finish(at(100s), 2, false);
  CHECK(content_of(dir / "disturbed.csv")
        == "t_s,provider,direction,station,what,lost,outage,stall,slow,copied,"
           "overtaken\n"
           "0.999000000,mec,up,101,one,0,0,1,0,0,2\n"
           "2.000000000,mec,down,102,CAM,1,1,0,3,0,0\n");
}

TEST_CASE("the summary says what happened") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  const auto end = r.finish(at(100s), 2, false);
  CHECK(end.virtual_s == 100);
  const auto s = summary_in(dir.path());
  CHECK(s["version"] == "0.1.0");
  CHECK(s["scenario"] == "made_up");
  CHECK(s["seed"] == 7);
  CHECK(s["virtual_s"] == 100);
  CHECK(s["interrupted"] == false);
  CHECK(s["vehicles"] == 2);
  CHECK(s["offers"] == 2);
  CHECK(s["requests"] == 5);
  CHECK(s["episodes"] == 3);
  CHECK(s["fallbacks"] == 1);
  CHECK(s["no_data"] == 1);
  CHECK(s["t_off_s"]["max"] == 20);
  CHECK(s["t_off_s"]["mean"] == 12.5);
  CHECK(s["offloaded_share"] == doctest::Approx(0.175));
  CHECK(s["latency_ms"]["p50"] == 10);
  CHECK(s["latency_ms"]["p95"] == 12);
  CHECK(s["latency_ms"]["max"] == 12.345678);
  CHECK(s["hand_overs"] == 0);
  CHECK(s["ping_pongs"] == 0);
  CHECK(s["fairness"] == doctest::Approx(35. * 35 / 2 / 725).epsilon(1e-6));
  CHECK(s["services"]["environment"]["fairness"].is_null());
  CHECK(s["interarrival_ms"]["mean"] == 50);
  CHECK(s["safety"]["without_fresh_plan_s"] == 0);
  CHECK(s["safety"]["max_plan_age_s"] == 0.18);
  CHECK(s["plans"]["count"] == 3000);
  CHECK(s["plans"]["emergency"] == 3);
  CHECK(s["plans"]["kept"] == 5);
  CHECK(s["plans"]["stops"] == 2);
  CHECK(s["plans"]["imperfect"] == 7);
  CHECK(s["plans"]["safe_stops"] == 1);
  CHECK(s["plans"]["max_lateral_accel_mps2"] == 2);
  CHECK(s["plans"]["max_jerk_mps3"] == 1.25);
  CHECK(s["plans"]["min_accel_mps2"] == -2.5);
  CHECK(s["driving"]["distance_m"] == 1700.5);
  CHECK(s["driving"]["max_lateral_accel_mps2"] == 1.75);
  CHECK(s["driving"]["max_jerk_mps3"] == 2);
  CHECK(s["driving"]["min_accel_mps2"] == -4);
  CHECK(s["cycles"]["on_board"] == 2600);
  CHECK(s["cycles"]["offloaded"] == 401);
  CHECK(s["energy"]["j"] == 1100.125);
  CHECK(s["energy"]["local_j"] == 1050);
  CHECK(s["energy"]["offloading_j"] == 50.125);
  CHECK(s["energy"]["all_on_board_j"] == 1250.5);
  CHECK(s["energy"]["saved_share"]
        == doctest::Approx(1 - 1100.125 / 1250.5).epsilon(1e-5));
  CHECK(s["energy"]["per_km_j"] == doctest::Approx(1100.125 / 1.7005));
  CHECK(s["driving"]["hard_brakes"] == 2);
  CHECK(s["driving"]["comfort_cost_m2ps3"] == 100.5);
  CHECK(s["traffic"]["delay_s"]["mean"] == 5.375);
  CHECK(s["traffic"]["delay_s"]["p95"] == 10);
  CHECK(s["traffic"]["delay_s"]["max"] == 10);
  CHECK(s["traffic"]["stops"] == 2);
  CHECK(s["traffic"]["longest_stop_s"] == 12.5);
  CHECK(s["traffic"]["arrived"] == 1);
  CHECK(s["traffic"]["arrived_per_h"] == 36);
  CHECK(s["switch"]["count"] == 2);
  CHECK(s["switch"]["mean_d_m"] == 0.5);
  CHECK(s["switch"]["max_d_m"] == 0.75);
  CHECK(s["switch"]["max_kappa_1pm"] == 0.002);
  CHECK(s["switch"]["max_v_mps"] == 0.5);
  CHECK(s["switch"]["mean_a_mps2"] == 0.5);
  CHECK(s["switch"]["max_a_mps2"] == 1);
  CHECK(s["ended_by"]["left_area"] == 1);
  CHECK(s["ended_by"]["shutdown"] == 0);
  CHECK(s["services"][planning]["requests"] == 5);
  CHECK(s["services"]["environment"]["accepted"] == 1);
  CHECK(s["services"]["environment"]["t_off_s"]["mean"].is_null());
  CHECK(s["services"]["environment"]["latency_ms"]["std"].is_null());
  CHECK(s["timing"]["wall_s"] == 2);
  CHECK(s["wall_s"] == 2);
  CHECK(s["timing"]["x_real_time"] == 50);
  std::vector<std::string> keys;
  for (const auto& [key, value] : s.items())
    keys.push_back(key);
  CHECK(keys.front() == "version");
  CHECK(keys.back() == "wall_s");
}

TEST_CASE("times in files count from the start and are exact to the ns") {
  const scratch dir;
  results r{dir.path(), run()};
  auto first = result(running(), 3, 60s, 12'345'678ns, std::nullopt);
  first.timing = {.input_at = first.created - 30ms,
                  .up = {2ms, 8ms},
                  .queue = 1ms,
                  .computing = 4ms,
                  .down = {300us, 7'045'678ns}};
  r.on_record(first);
  auto late = result(running(), 4, 60s + 50ms + 1ns, 9ms, 46'654'323ns);
  late.used = false;
  late.doubt = 250us;
  late.timing.input_at = late.created;
  r.on_record(late);
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "cycles.csv");
  REQUIRE(all.size() == 3);
  CHECK(all[0]
        == "station,provider,provider_id,service,counter,cycle,created_s,"
           "received_s,latency_ms,input_age_ms,interarrival_ms,used,doubt_ms,"
           "uplink_wait_ms,uplink_ms,queue_ms,computing_ms,downlink_wait_ms,"
           "downlink_ms,rest_ms");
  CHECK(all[1]
        == "101,mec,18000000000000000000,trajectory_planning,1,3,"
           "60.000000000,60.012345678,12.345678,42.345678,,1,,2.000000,"
           "8.000000,1.000000,4.000000,0.300000,7.045678,20.000000");
  CHECK(all[2]
        == "101,mec,18000000000000000000,trajectory_planning,1,4,"
           "60.050000001,60.059000001,9.000000,9.000000,46.654323,0,0.250000,"
           "0.000000,0.000000,0.000000,0.000000,0.000000,0.000000,9.000000");
}

TEST_CASE("each closed side is a line in episodes.csv") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "episodes.csv");
  REQUIRE(all.size() == 5);
  CHECK(all[0]
        == "side,station,provider,provider_id,service,counter,accepted_s,"
           "first_data_s,ended_s,t_off_s,reason,fallback,because");
  CHECK(all[1]
        == "requester,101,mec,18000000000000000000,trajectory_planning,1,"
           "9.900000000,10.000000000,30.000000000,20.000000000,left_area,0,");
  CHECK(all[2]
        == "provider,101,mec,18000000000000000000,trajectory_planning,1,"
           "9.000000000,,30.000000000,,left_area,0,x_m=1 y_m=2");
  CHECK(all[4]
        == "requester,102,mec,18000000000000000000,trajectory_planning,3,"
           "40.000000000,,41.000000000,,no_data,0,");
}

TEST_CASE("tracks have millimetres, and zero has no sign") {
  const scratch dir;
  results r{dir.path(), run()};
  r.on_record(track());
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "tracks.csv");
  REQUIRE(all.size() == 2);
  CHECK(all[0]
        == "t_s,station,x_m,y_m,heading_rad,speed_mps,accel_mps2,s_m,"
           "lateral_m,plan_age_ms,source");
  CHECK(all[1]
        == "1.500000000,101,571656.123,5364810.500,-1.500000,8.250,0.000,"
           "12.000,-0.063,73.000000,remote");
}

TEST_CASE("each vehicle is a line in vehicles.csv, by station") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.on_record(collision_record{at(2s), 9, 101});
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "vehicles.csv");
  REQUIRE(all.size() == 4);
  CHECK(all[0]
        == "station,driven_s,distance_m,without_fresh_plan_s,off_road_s,"
           "collisions,max_plan_age_ms,plans,emergency_plans,kept_plans,"
           "stop_plans,imperfect_plans,safe_stops,min_accel_mps2,max_jerk_mps3,"
           "max_lateral_accel_mps2,hard_brakes,"
           "comfort_cost_m2ps3,delay_s,stops,longest_stop_s,arrived,"
           "on_board_cycles,offloaded_cycles,energy_j,"
           "all_on_board_j");
  CHECK(all[1].starts_with("9,"));
  CHECK(all[2]
        == "101,100.000000000,900.000,0.000000000,0.000000000,1,150.000000,"
           "2000,3,4,2,6,1,-4.000000,1.500000,1.750000,2,80.000000,"
           "10.000,2,12.500,0,1600,401,850.125000,1000.500000");
  CHECK(all[3]
        == "102,100.000000000,800.500,0.000000000,0.000000000,0,180.000000,"
           "1000,0,1,0,1,0,-2.500000,2.000000,1.000000,0,20.500000,"
           "0.750,0,0.000,1,1000,0,250.000000,250.000000");
}

TEST_CASE("a switch of plans is an event with its jumps") {
  const scratch dir;
  results r{dir.path(), run()};
  r.on_record(plan_switch_record{
      at(10s), running(101, 1), false, {0.25, 0.00015, 0.5, 1.75}});
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "events.jsonl");
  REQUIRE(all.size() == 1);
  CHECK(all[0]
        == "{\"t_s\":10.000000000,\"what\":\"plan_switch\",\"station\":101,"
           "\"provider\":\"mec\",\"provider_id\":18000000000000000000,"
           "\"service\":\"trajectory_planning\",\"counter\":1,"
           "\"detail\":\"local d_m=0.250000 kappa_1pm=0.000150 "
           "v_mps=0.500000 a_mps2=1.750000\"}");
}

TEST_CASE("every event is a JSON object, whatever its text") {
  const scratch dir;
  results r{dir.path(), run()};
  const std::string odd = "say \"no\"\\\n\tt_off \x01 \xff ü";
  r.on_record(event_record{at(1s), event_type::stay_local, 101, provider,
                           planning, 4, odd});
  r.on_record(collision_record{at(2s), 101, 102});
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "events.jsonl");
  REQUIRE(all.size() == 2);
  using json = nlohmann::ordered_json;
  const auto event = json::parse(all[0]);
  CHECK(event["t_s"] == 1);
  CHECK(event["provider"] == "mec");
  CHECK(event["provider_id"] == provider.value());
  CHECK(event["counter"] == 4);
  CHECK(event["detail"] == "say \"no\"\\\n\tt_off \x01 \ufffd ü");
  CHECK(all[1]
        == "{\"t_s\":2.000000000,\"what\":\"collision\",\"station\":101,"
           "\"provider\":\"\",\"provider_id\":0,\"service\":\"\","
           "\"counter\":0,\"detail\":\"with 102\"}");
}

TEST_CASE("a name with a comma stays one field") {
  std::string out;
  append(out, std::string_view{"plain"});
  append(out, std::string_view{"a,b"});
  append(out, std::string_view{"say \"no\""});
  CHECK(out == "plain\"a,b\"\"say \"\"no\"\"\"");
}

TEST_CASE("decimals are exact at both ends of their range") {
  const auto text = [](decimal x) {
    std::string out;
    append(out, x);
    return out;
  };
  CHECK(text({0, 0}) == "0");
  CHECK(text({5, 3}) == "0.005");
  CHECK(text({-5, 3}) == "-0.005");
  CHECK(text({INT64_MAX, 9}) == "9223372036.854775807");
  CHECK(text({INT64_MIN, 18}) == "-9.223372036854775808");
  CHECK(text(rounded(0.0005, 3)) == "0.001");
  CHECK(text(rounded(-0.0004, 3)) == "0.000");
  CHECK(text(rounded(NAN, 3)).empty());
  CHECK(text(rounded(-INFINITY, 3)).empty());
  CHECK(text(rounded(1e17, 3)).empty());
}

TEST_CASE("distributions hold every duration once") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.finish(at(100s), 2, false);
  const auto all = lines(dir / "distributions.csv");
  REQUIRE(all.size() > 2);
  CHECK(all[0] == "service,figure,up_to_ms,count");
  std::uint64_t latencies = 0;
  for (const auto& line : all)
    if (line.starts_with("trajectory_planning,latency,"))
      latencies += std::stoull(line.substr(line.rfind(',') + 1));
  CHECK(latencies == summary_in(dir.path())["latency_ms"]["count"]);
}

TEST_CASE("the same records give the same bytes, whatever the wall's clock") {
  const scratch first, second;
  for (const auto* dir : {&first, &second}) {
    results r{dir->path(), run()};
    play(r);
    r.on_record(track());
    r.finish(at(100s), dir == &first ? 2 : 3, false);
  }
  for (const auto* name :
       {"config.toml", "episodes.csv", "cycles.csv", "distributions.csv",
        "tracks.csv", "vehicles.csv", "events.jsonl"})
    CHECK(content_of(first / name) == content_of(second / name));
  auto one = summary_in(first.path()), other = summary_in(second.path());
  CHECK(one != other);
  one.erase("timing");
  one.erase("wall_s");
  other.erase("timing");
  other.erase("wall_s");
  CHECK(one == other);
}

TEST_CASE("figures of the wall's clock have a file of their own") {
  const scratch dir;
  results r{dir.path(), run()};
  r.add_timing("solve_p99_us", 31.5);
  r.finish(at(100s), 2, false);
  CHECK(content_of(dir / "timing.csv")
        == "figure,value\nwall_s,2.000000\nx_real_time,50.000000\n"
           "solve_p99_us,31.500000\n");
}

TEST_CASE("a run without any record has a summary full of nulls") {
  const scratch dir;
  results r{dir.path(), run()};
  r.finish(start, 0, false);
  const auto s = summary_in(dir.path());
  CHECK(s["virtual_s"] == 0);
  CHECK(s["offloaded_share"].is_null());
  CHECK(s["cycles"]["offloaded_share"].is_null());
  CHECK(s["energy"]["j"].is_null());
  CHECK(s["energy"]["saved_share"].is_null());
  CHECK(s["latency_ms"]["p99"].is_null());
  CHECK(s["safety"]["max_plan_age_s"].is_null());
  CHECK(s["plans"]["count"] == 0);
  CHECK(s["plans"]["max_jerk_mps3"].is_null());
  CHECK(s["driving"]["min_accel_mps2"].is_null());
  CHECK(s["switch"]["count"] == 0);
  CHECK(s["switch"]["max_d_m"].is_null());
  CHECK(lines(dir / "vehicles.csv").size() == 1);
  CHECK(s["timing"]["x_real_time"].is_null());
}

TEST_CASE("an interrupted run keeps its figures and says so") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.finish(at(95s), 2, true);
  const auto s = summary_in(dir.path());
  CHECK(s["interrupted"] == true);
  CHECK(s["virtual_s"] == 95);
  CHECK(s["episodes"] == 3);
  CHECK(lines(dir / "cycles.csv").size() == 402);
}

TEST_CASE("a killed run keeps what was flushed, but has no summary") {
  const scratch dir;
  results r{dir.path(), run()};
  play(r);
  r.flush();
  CHECK(lines(dir / "cycles.csv").size() == 402);
  CHECK(lines(dir / "episodes.csv").size() == 5);
  CHECK_FALSE(fs::exists(dir / "summary.json"));
}

TEST_CASE("a run that nobody finishes keeps its lines") {
  const scratch dir;
  {
    results r{dir.path(), run()};
    play(r);
  }
  CHECK(lines(dir / "cycles.csv").size() == 402);
  CHECK_FALSE(fs::exists(dir / "summary.json"));
}

TEST_CASE("a long run reaches the disk without being asked to") {
  const scratch dir;
  results r{dir.path(), run()};
  for (int i = 0; i < 10'000; ++i)
    r.on_record(track());
  CHECK(fs::file_size(dir / "tracks.csv") > 500'000);
}

TEST_CASE("a full disk is reported in a sentence that says what to do") {
  if (!fs::exists("/dev/full")) {
    MESSAGE("skipped: there is no /dev/full here");
    return;
  }
  output_file full{"/dev/full"};
  full.text() = "something";
  const auto said = complaint([&full] { full.flush(); });
  CHECK(contains(said, "/dev/full"));
  CHECK(contains(said, "No space left"));
  CHECK(contains(said, "--out"));
  CHECK(full.text().empty());
}

TEST_CASE("a folder that cannot be written to is reported") {
  const scratch dir;
  const auto said = complaint([&dir] { results{dir / "missing", run()}; });
  CHECK(contains(said, "missing"));
  CHECK(contains(said, "No such file"));
}

} // namespace sofof::made_up
