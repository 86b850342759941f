// What is said about scenarios that are wrong.
#include "tests/scenario/example.hpp"
#include "tests/support/mistakes.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;

namespace {

/// Checks what is said about mistakes in the example.
void check_scenario_mistakes(const std::vector<mistake>& mistakes) {
  for (const auto& m : mistakes) {
    CAPTURE(m.wrong);
    auto text = example::with(m.right, m.wrong);
    const auto place = "example.toml" + take_mark(text);
    check_says(example::error_of(text), place, m.says);
  }
}

/// Checks what is said about `--set`.
void check_set(const std::string& assignment,
               const std::vector<std::string_view>& says) {
  CAPTURE(assignment);
  const auto error = example::error_of(example::text, {assignment});
  CHECK(error.starts_with("--set " + assignment + ": "));
  check_says(error, assignment, says);
}

/// @returns the example without the part from one text up to another.
std::string without(std::string_view from, std::string_view to) {
  auto text = example::text;
  const auto begin = text.find(from);
  return text.erase(begin, text.find(to) - begin);
}

} // namespace

TEST_CASE("the example itself is right") {
  CHECK(example::error_of(example::text) == "");
}

TEST_CASE("a missing file is named") {
  try {
    load_scenario("nowhere/town.toml");
    FAIL_CHECK("nothing is said");
  } catch (const input_error& problem) {
    check_says(problem.what(), "nowhere/town.toml: ", {"cannot be read"});
  }
  CHECK_THROWS_AS(load_scenario(SOFOF_SOURCE_DIR), input_error);
}

TEST_CASE("TOML that cannot be parsed is refused with its place") {
  check_scenario_mistakes({
      {"seed = 7", "seed = @= 7", {}},
      {"[[fleet]]", "[[fleet]@\n", {}},
      {"seed = 7", "seed = 7\nseed = @8", {"seed"}},
  });
}

TEST_CASE("an unknown option is refused with the one that was meant") {
  check_scenario_mistakes({
      {"seed = 7", "@sed = 7", {"\"sed\"", "did you mean \"seed\"?"}},
      {"area_radius_m", "@area_radus_m", {"did you mean \"area_radius_m\"?"}},
      {"min_distance_m", "@distance_m", {"min_distance_m"}},
      {"[record]", "[@recordings]", {"recordings", "record"}},
      {"codm = \"always\"",
       "codm = { name = \"always\", @min_time = \"5s\" }",
       {"min_time", "Known: name"}},
      {"[network]", "[network]\n@frequency_ghz = 3.7", {"profile"}},
      {"[network]", "@[[network]]", {"must be a table"}},
  });
}

TEST_CASE("what says nothing of a network or a failure is refused") {
  check_scenario_mistakes({
      {"[network]", "[network]\nspikes = { probability = @0.1 }", {"longest"}},
      {"[network]", "[network]\ndrift = { sd = @0.1 }", {"period"}},
      {"[network]",
       "[network]\n[[network.outage]]\nfrom = \"2s\"\nto = @\"1s\"",
       {"later than from"}},
      {"[network]", "[network]\n@[[network.area]]\nloss = 0.5", {"area_m"}},
      {"[network]",
       "[network]\n@[[network.area]]\nposition_m = [0, 0]",
       {"changes nothing"}},
      {"[network]",
       "[network]\n[[network.area]]\nposition_m = [0, 0]\nloss = @1.5",
       {"loss", "from 0 to 1"}},
      {"[network]",
       "[network]\n[[network.area]]\nposition_m = [0, 0]\nloss = 0.5\n"
       "radius_m = @-3",
       {"radius_m", "from 0.1"}},
      {"[network]",
       "[network]\n[[network.area]]\nloss = 0.5\n"
       "area_m = @[[0, 0], [9, 9], [9, 0], [0, 9]]",
       {"area_m"}},
      {"[network]",
       "[network]\n[[network.area]]\narea_m = [[0, 0], [9, 0], [9, 9]]\n"
       "radius_m = @3",
       {"has no effect beside area_m"}},
      {"[network]",
       "network = { profile = @\"trace\", trace = \"delays.csv\" }\n[network]",
       {"only [network] can"}},
      {"[network]", "returns_at = @\"9s\"\n[network]", {"fails_at"}},
      {"[network]",
       "fails_at = \"9s\"\nreturns_at = @\"9s\"\n[network]",
       {"later than fails_at"}},
  });
}

TEST_CASE("a forecast that has nothing to go by is refused") {
  check_scenario_mistakes({
      {"[record]",
       "[policies.forecast]\nsource = @\"learnt\"\n[record]",
       {"did you mean \"learned\"?"}},
      {"[record]",
       "[policies.forecast]\nsource = @\"file\"\n[record]",
       {"needs a file"}},
      {"[record]",
       "[policies.forecast]\nsource = \"oracle\"\nshared = @true\n[record]",
       {"has no effect unless"}},
      {"[record]",
       "[policies.forecast]\nsource = \"oracle\"\nfile = @\"q.csv\"\n"
       "[record]",
       {"has no effect unless"}},
      {"[record]",
       "[policies.forecast]\nsource = \"file\"\nfile = @\"no.csv\"\n[record]",
       {"no.csv", "cannot be read"}},
      {"[record]",
       "[policies.forecast]\nsource = \"learned\"\ncell_m = @0\n[record]",
       {"from 1 to 1000"}},
  });
}

TEST_CASE("a value of the wrong type is refused") {
  check_scenario_mistakes({
      {"seed = 7", "seed = @1.5", {"whole number", "1.5"}},
      {"seed = 7", "seed = @\"7\"", {"whole number", "\"7\""}},
      {"\"600s\"", "@600", {"duration", "with its unit", "600"}},
      {"\"600s\"", "@\"600\"", {"duration", "with its unit", "\"600\""}},
      {"\"example\"", "@true", {"name", "text in quotes", "true"}},
      {"cycles = false", "cycles = @0", {"true or false"}},
      {"connected = false", "connected = @\"no\"", {"true or false"}},
      {"area_radius_m = 80.0", "area_radius_m = @\"80\"", {"a number"}},
      {"[0.0, 0.0]", "@[0.0]", {"point [x, y]"}},
      {"[0.0, 0.0]", "[0.0, @\"north\"]", {"number", "north"}},
      {"[50, 0]", "@50", {"area_m", "point"}},
      {"[\"cabin_climate\"]", "@\"cabin_climate\"", {"a list of texts"}},
      {"[\"cabin_climate\"]", "[@1]", {"text in quotes"}},
      {"[record]", "@record = 3\n[never]", {}},
  });
}

TEST_CASE("a number out of its range is refused") {
  check_scenario_mistakes({
      {"\"600s\"", "@\"0s\"", {"more than \"0s\""}},
      {"\"600s\"", "@\"-5s\"", {"more than \"0s\"", "-5s"}},
      {"\"250ms\"", "@\"250us\"", {"at least \"10ms\""}},
      {"\"250ms\"", "@\"255ms\"", {"multiple of \"10ms\""}},
      {"count = 6", "count = @0", {"count", "from 1 to", "0"}},
      {"count = 6", "count = @-1", {"count", "from 1 to", "-1"}},
      {"seed = 7", "seed = @-7", {"from 0"}},
      {"radius_m = 250.0", "radius_m = @-1", {"from 0", "-1"}},
      {"radius_m = 250.0", "radius_m = @nan", {"nan"}},
      {"radius_m = 250.0", "radius_m = @inf", {"inf"}},
      {"position_m = [0.0, 0.0]", "position_m = [0.0, @inf]", {"position_m"}},
      {"start_speed_mps = 8.5", "start_speed_mps = @-1", {"from 0 to 50"}},
      {"first_station = 201", "first_station = @4294967295", {"too few"}},
      {"first_station = 201", "first_station = @4294967296", {"from 1 to"}},
      {"area_radius_m = 80.0", "area_radius_m = 80\narea_corners = @2", {"3"}},
  });
}

TEST_CASE("a sensor that cannot be is refused") {
  const auto sensors = [](const std::string& option) {
    return "[sensors]\n" + option + "\n[network]";
  };
  const auto roadside = sensors("[[provider.sensor]]\nrange_m = @-1");
  check_scenario_mistakes({
      {"[network]", sensors("range_m = @-1"), {"range_m", "from 0", "-1"}},
      {"[network]", sensors("range_m = @1001"), {"to 1000"}},
      {"[network]", sensors("field_of_view_deg = @361"), {"to 360"}},
      {"[network]", sensors("position_noise_m = @-0.1"), {"from 0"}},
      {"[network]", sensors("speed_noise_mps = @nan"), {"nan"}},
      {"[network]", sensors("heading_noise_rad = @4"), {"heading_noise_rad"}},
      {"[network]", sensors("occlusion = @1"), {"true or false"}},
      {"[network]", sensors("@range = 1"), {"did you mean \"range_m\"?"}},
      {"[network]", roadside, {"range_m", "from 0"}},
      {"[network]", "[sensors]\n[[provider.sensor]]\n@at = 1\n[network]", {}},
  });
}

TEST_CASE("driving that cannot work is refused") {
  const auto planner = [](const std::string& option) {
    return "max_latency = \"50ms\"\nplanner = { " + option + " }";
  };
  const std::string right = "max_latency = \"50ms\"";
  const auto decel = planner("max_decel_mps2 = @2.4");
  const auto soft = planner("comfort_decel_mps2 = 2.4, max_decel_mps2 = @2.99");
  const auto coarse = planner("onboard = { horizon_m = 31.5, step_m = @2 }");
  const auto fine = planner("provider = { horizon_m = 129, step_m = @0.5 }");
  check_scenario_mistakes({
      {right, decel, {"max_decel_mps2", "from 2.5", "2.4"}},
      {right, soft, {"max_decel_mps2", "at least 3", "comfort_decel_mps2"}},
      {right, coarse, {"step_m", "at most horizon_m / 16"}},
      {right, fine, {"step_m", "at least horizon_m / 256"}},
  });
  const auto loads = [&](const std::string& option) {
    return example::error_of(example::with(right, planner(option))) == "";
  };
  CHECK(loads("comfort_decel_mps2 = 2.0, max_decel_mps2 = 2.5"));
  CHECK(loads("onboard = { horizon_m = 32, step_m = 2 }"));
  CHECK(loads("mec = { horizon_m = 126 }")); // as it was called
}

TEST_CASE("a start beyond the speed limit is refused") {
  check_scenario_mistakes({{"start_speed_mps = 8.5",
                            "start_speed_mps = @13.91",
                            {"vehicle 201", "straight", "13.91", "13.9 m/s"}}});
  CHECK(example::error_of(
            example::with("start_speed_mps = 8.5", "start_speed_mps = 13.9"))
        == "");
}

TEST_CASE("messages that nobody can send are refused") {
  const auto v2x = [](const std::string& option) {
    return "[v2x]\n" + option + "\n[network]";
  };
  check_scenario_mistakes({
      {"[network]",
       v2x("cam = @\"trigered\""),
       {"\"trigered\"", "rule for CAMs", "did you mean \"triggered\"?",
        "fixed_10hz"}},
      {"[network]", v2x("cam = @\"off\""), {"triggered", "fixed_10hz"}},
      {"[network]",
       v2x("cpm = @\"of\""),
       {"rule for CPMs", "did you mean \"off\"?", "triggered"}},
      {"[network]",
       v2x("cpm_version = @\"tr103652\""),
       {"version of the CPM", "did you mean \"tr103562\"?", "ts103324"}},
      {"[network]", v2x("cpm = @10"), {"text in quotes"}},
      {"[network]", v2x("@cpm_rate_hz = 10"), {"cpm_rate_hz", "cpm"}},
      {"[network]", "[network]\ncell_mbps = @-1", {"cell_mbps", "from 0"}},
      {"[network]", "[network]\ncell_mbps = @1e7", {"to 1000000"}},
  });
}

TEST_CASE("vehicles with numbers of providers are refused") {
  const std::string right = "count = 6\nfirst_station = 101";
  const std::vector<std::string_view> says{"stations 900000001 to 901000000",
                                           "providers", "at 901000001"};
  check_scenario_mistakes({
      {right, "count = 6\nfirst_station = @899999996", says},
      {right, "count = 6\nfirst_station = @900000001", says},
      {right, "count = 6\nfirst_station = @901000000", says},
  });
  for (const auto* good : {"899999995", "901000001"})
    CHECK(example::error_of(example::with(
              right, std::string{"count = 6\nfirst_station = "} + good))
          == "");
}

TEST_CASE("an obstacle that cannot be is refused") {
  const auto obstacle = [](const std::string& options) {
    return "[[obstacle]]\n" + options + "\n[network]";
  };
  const std::string rest = "\nroutes = [\"straight\"]\nplacement = "
                           "\"convoy\"\nstart_m = 150.0\nstart_speed_mps = "
                           "8.5\nconnected = false";
  const auto second = "first_station = 201" + rest;
  check_scenario_mistakes({
      {"[network]", obstacle("length_m = @0"), {"length_m", "from 0.1"}},
      {"[network]", obstacle("width_m = @-1"), {"width_m", "from 0.1"}},
      {"[network]", obstacle("heading_deg = @720"), {"heading_deg", "360"}},
      {"[network]", obstacle("@speed_mps = 1"), {"speed_mps"}},
      {"[network]",
       "@[[obstacle]]\nposition_m = [100.0, 2.0]\n[network]",
       {"vehicle 101", "start on it"}},
      {second,
       "first_station = @4294967294" + rest + "\n[[obstacle]]",
       {"above 4294967294", "begin lower"}},
  });
}

TEST_CASE("an option that would have no effect is refused") {
  const auto with = [](const char* option) {
    try {
      example::load(example::text, {option});
    } catch (const input_error& e) {
      return std::string{e.what()};
    }
    return std::string{"loaded"};
  };
  CHECK(with("network.stalls.rate_hz=0.1").find("no effect")
        != std::string::npos);
  CHECK(with("network.burst_loss.mean_good=5s").find("no effect")
        != std::string::npos);
  CHECK(with("network.burst_loss.mean_bad=5s").find("no effect")
        != std::string::npos);
}

TEST_CASE("an area that is no polygon is refused") {
  check_scenario_mistakes({
      {"[[0, 0], [50, 0], [50.5, 50], [0, 50]]",
       "@[[0, 0], [50, 0]]",
       {"area_m", "three corners"}},
      {"[[0, 0], [50, 0], [50.5, 50], [0, 50]]", "@[]", {"three corners"}},
      {"[[0, 0], [50, 0], [50.5, 50], [0, 50]]",
       "@[[0, 0], [50, 50], [50, 0], [0, 50]]",
       {"area_m", "crosses itself"}},
      {"services = [\"cabin",
       "area_radius_m = @3\nservices = [\"cabin",
       {"no effect beside area_m"}},
  });
}

TEST_CASE("an unknown name is refused with those that are known") {
  check_scenario_mistakes({
      {"codm = \"always\"",
       "codm = @\"allways\"",
       {"\"allways\"", "CODM policy", "did you mean \"always\"?", "location",
        "never"}},
      {"name = \"location\"",
       "name = @\"orakel\"",
       {"LODM policy", "location"}},
      {"codm = \"always\"",
       "codm = @\"nearest\"",
       {"It is an LODM: lodm = \"nearest\"."}},
      {"name = \"location\"",
       "name = @\"edf\"",
       {"It is a CODM: codm = \"edf\"."}},
      {"name = \"location\"",
       "name = @\"hysteresis\"",
       {"It is a governor: lodm = { name = \"location\", govern = [{ name = "
        "\"hysteresis\" }] }."}},
      {"\"paper_sim\"",
       "@\"paper_7g\"",
       {"did you mean \"paper_5g\"?", "ideal"}},
      {"name = \"cabin_climate\"",
       "name = @\"radio\"",
       {"kind of service", "trajectory_planning"}},
      {"placement = \"equal\"", "placement = @\"random\"", {"convoy", "equal"}},
      {"\"perceived\"", "@\"seen\"", {"crossings", "granted", "perceived"}},
      {"\"round_trip_opposite\"",
       "@\"round_trip_oposite\"",
       {"route", "did you mean \"round_trip_opposite\"?", "straight"}},
      {"[\"cabin_climate\"]",
       "[@\"coffee\"]",
       {"\"coffee\"", "[[service]]", "cabin_climate"}},
  });
}

TEST_CASE("only planning alone may leave its limit to the scene, under a cap "
          "that is not below the floor") {
  const std::string right = "max_latency = \"50ms\"";
  CHECK(example::error_of(example::with(right, "max_latency = \"scene\"\n"
                                               "max_latency_cap = \"200ms\""))
        == "");
  check_scenario_mistakes(
      {{right,
        "max_latency = \"scene\"\nmax_latency_cap = \"30ms\"\n"
        "max_latency_floor = @\"40ms\"",
        {"max_latency_floor", "max_latency_cap"}},
       {right, "max_latency = @\"scenery\"", {"max_latency", "duration"}},
       {right, right + "\n@max_latency_cap = \"200ms\"", {"max_latency_cap"}},
       {"[[service]]\nname = \"cabin_climate\"",
        "[[service]]\nname = \"cabin_climate\"\nmax_latency = @\"scene\"",
        {"max_latency", "trajectory_planning"}}});
}

TEST_CASE("a service without a name is refused with those that are known") {
  check_scenario_mistakes(
      {{"[[service]]\nname = \"cabin_climate\"",
        "@[[service]]\nmax_latency = \"50ms\"",
        {"kind of service", "cabin_climate", "trajectory_planning"}}});
}

TEST_CASE("names that must differ are refused where the second stands") {
  check_scenario_mistakes({
      {"name = \"cloud\"", "name = @\"mec\"", {"two providers \"mec\""}},
      {"name = \"cabin_climate\"",
       "name = @\"trajectory_planning\"",
       {"two services"}},
      {"first_station = 201",
       "first_station = @106",
       {"station 106", "begin at 107"}},
  });
}

TEST_CASE("names and lists that must not be empty are refused") {
  check_scenario_mistakes({
      {"name = \"example\"", "name = @\"\"", {"name", "must not be empty"}},
      {"[\"straight\"]", "@[]", {"routes", "at least one"}},
      {"[\"cabin_climate\"]", "@[]", {"services", "at least one"}},
  });
}

TEST_CASE("a file that is named but missing is refused where it is named") {
  check_scenario_mistakes({
      {"\"ring.toml\"",
       "@\"nowhere.toml\"",
       {"nowhere.toml", "cannot be read"}},
      {"profile = \"paper_sim\"",
       "profile = \"trace\"\ntrace = @\"nowhere.csv\"",
       {"nowhere.csv", "cannot be read"}},
      {"profile = \"paper_sim\"",
       "profile = \"trace\"\ntrace = @\"\"",
       {"file"}},
      {"profile = \"paper_sim\"", "profile = @\"trace\"", {"trace = \"FILE\""}},
      {"profile = \"paper_sim\"",
       "profile = \"ideal\"\ntrace = @\"delays.csv\"",
       {"no effect"}},
      {"profile = \"paper_sim\"",
       "profile = \"trace\"\ntrace = @\"broken_delays.csv\"",
       {"broken_delays.csv", "line 3", "late"}},
  });
}

TEST_CASE("vehicles that have no room are refused") {
  const auto second = "[[fleet]]\ncount = 2\nfirst_station = 201";
  check_scenario_mistakes({
      {"[[fleet]]\ncount = 6\nfirst_station = 101",
       "@[[fleet]]\ncount = 190\nfirst_station = 301",
       {"vehicle 3", "round_trip", "less than 3 m apart", "fewer vehicles"}},
      {second,
       "@[[fleet]]\nspacing_m = 8\ncount = 2\nfirst_station = 201",
       {"vehicle 201", "vehicle 202", "less than 3 m apart"}},
      {second,
       "@[[fleet]]\ncount = 4\nfirst_station = 201",
       {"vehicle 204", "-30 m", "straight"}},
      {"[[fleet]]\ncount = 2\nfirst_station = 201\nroutes = [\"straight\"]\n"
       "placement = \"convoy\"\nstart_m = 150.0",
       "@[[fleet]]\ncount = 2\nfirst_station = 201\nroutes = [\"straight\"]\n"
       "placement = \"convoy\"\nstart_m = 250.0",
       {"vehicle 201", "250 m", "straight"}},
  });
}

TEST_CASE("a scenario without streets, vehicles or services is refused") {
  const auto file = "example.toml: ";
  check_says(example::error_of(without("map = ", "\n[[fleet]]")), file,
             {"no streets", "map = \"FILE\"", "[street_grid]"});
  check_says(example::error_of(without("[[fleet]]", "[[provider]]")), file,
             {"no vehicles", "[[fleet]]"});
  check_says(example::error_of(without("[[service]]", "[policies]")), file,
             {"[[service]]", "trajectory_planning"});
  check_says(example::error_of(""), file, {"no streets"});
}

TEST_CASE("a map and a street grid together are refused") {
  check_scenario_mistakes(
      {{"map = \"ring.toml\"", "map = @\"ring.toml\"\n[street_grid]\n", {}}});
}

TEST_CASE("a wrong --set is refused with what was typed") {
  check_set("seed=many", {"whole number", "many"});
  check_set("duration=-5s", {"more than \"0s\""});
  check_set("duration=60", {"with its unit"});
  check_set("sed=3", {"did you mean \"seed\"?"});
  check_set("provider.0.area_raduis_m=3", {"area_radius_m"});
  check_set("provider.0.area_radius_m=0", {"from 1"});
  check_set("provider.7.area_radius_m=3", {"\"7\""});
  check_set("provider.fog.area_radius_m=3", {"\"fog\"", "Known: "});
  check_set("fleet.0.count.more=3", {"count"});
  check_set("fleet=3", {"[[fleet]]"});
  check_set("name.first=Anna", {"text in quotes"});
  check_set("policies.codm=oracle", {"CODM policy", "never"});
  check_set("policies.codm.min_time=5s", {"min_time"});
  check_set("fleet.0.routes.1=straigt", {"did you mean \"straight\"?"});
  check_set("fleet.0.routes.2=straight", {"\"2\""});
  check_set("map=nowhere.toml", {"nowhere.toml"});
  check_set("fleet.1.first_station=101", {"station 101"});
  check_set("record.speed=3", {"tracks_period"});
  check_set("records.cycles=true", {"did you mean \"record\"?"});
  check_set("seed", {"KEY=VALUE"});
  check_set("=3", {"empty"});
  check_set("record..cycles=true", {"empty"});
  check_set("name=\xff", {});
  check_set("fleet.city.count=3", {"there is no \"city\"."});
  CHECK(example::error_of(example::text, {"fleet.city.count=3"})
            .ends_with("there is no \"city\"."));
}

TEST_CASE("a --set that nests too deep is refused before it is read") {
  const auto error =
      example::error_of(example::text, {"seed=" + std::string(100'000, '[')
                                        + std::string(100'000, ']')});
  CHECK(error.starts_with("--set seed=[["));
  CHECK(error.find("nested deeper than") != error.npos);
}
