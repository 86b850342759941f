// From a scenario file to a scenario.
#include "scenario/load.hpp"

#include "tests/scenario/example.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <chrono>

using namespace sofof;
using namespace sofof::scenario;
using namespace std::chrono_literals;

TEST_CASE("a scenario holds what its file says") {
  const auto s = example::load();
  CHECK(s.name == "example");
  CHECK(s.length == 600s);
  CHECK(s.seed == 7);
  REQUIRE(s.fleets.size() == 2);
  CHECK(s.fleets[0].count == 6);
  CHECK(s.fleets[0].first_station == 101);
  CHECK(s.fleets[0].routes
        == std::vector<std::string>{"round_trip", "round_trip_opposite"});
  CHECK(s.fleets[1].placement == "convoy");
  CHECK(s.fleets[1].start_m == 150);
  CHECK(s.fleets[1].start_speed_mps == 8.5);
  CHECK_FALSE(s.fleets[1].connected);
  CHECK_FALSE(s.traffic.grants_crossings());
  REQUIRE(s.providers.size() == 2);
  CHECK(s.providers[0].area_radius_m == 80);
  CHECK(s.providers[1].area_m.size() == 4);
  CHECK(s.providers[1].area_m[2] == point{50.5, 50});
  CHECK(s.providers[1].services == std::vector<std::string>{"cabin_climate"});
  REQUIRE(s.services.size() == 2);
  CHECK(s.services[0]->name() == "trajectory_planning");
  CHECK(s.services[0]->options.limits.max_latency == 50ms);
  CHECK(s.policies.lodm->name() == "location");
  CHECK(s.policies.codm->name() == "always");
  CHECK(s.network.channel->name == "paper_sim");
  CHECK(s.record.tracks_period == 250ms);
  CHECK_FALSE(s.record.cycles);
}

TEST_CASE("what a file leaves out keeps its default") {
  const auto s = example::load();
  CHECK(s.fleets[0].spacing_m == fleet_options{}.spacing_m);
  CHECK(s.fleets[0].start_speed_mps == 0);
  CHECK(s.fleets[0].connected);
  CHECK(s.providers[0].area_corners == 24);
  CHECK(s.providers[0].services.empty());
  CHECK(s.record.tracks);
}

TEST_CASE("sensors and obstacles are what the file says") {
  const auto s = example::load(example::with(
      "[network]", "[[provider.sensor]]\nposition_m = [1.0, 2.0]\n"
                   "heading_deg = 90\nocclusion = false\n"
                   "[[provider.sensor]]\nspeed_noise_mps = 0.5\n"
                   "[sensors]\nrange_m = 60.0\nfield_of_view_deg = 120\n"
                   "[[obstacle]]\nposition_m = [5.0, 6.0]\n"
                   "heading_deg = -90\nlength_m = 8\n[network]"));
  CHECK(s.sensors.range_m == 60);
  CHECK(s.sensors.field_of_view_deg == 120);
  CHECK(s.sensors.position_noise_m == 0.1);
  CHECK(s.sensors.occlusion);
  CHECK(s.providers[0].sensors.empty());
  REQUIRE(s.providers[1].sensors.size() == 2);
  const random_stream noise{1, "test"};
  const auto first = s.providers[1].sensors[0].make(noise);
  CHECK(first.at == point{1, 2});
  CHECK(first.heading_rad == doctest::Approx(1.5707963));
  CHECK(first.can.range_m == 120);
  CHECK_FALSE(first.can.occlusion);
  CHECK_FALSE(first.carrier);
  CHECK(first.noise.bits(0) == noise.bits(0));
  CHECK(s.providers[1].sensors[1].can.speed_noise_mps == 0.5);
  REQUIRE(s.obstacles.size() == 1);
  const auto box = s.obstacles[0].box();
  CHECK(box.centre == point{5, 6});
  CHECK(box.heading_rad == doctest::Approx(-1.5707963));
  CHECK(box.length_m == 8);
  CHECK(box.width_m == 1.8);
}

TEST_CASE("a scenario that says nothing of sensors has them") {
  const auto s = example::load();
  CHECK(s.sensors.range_m == 100);
  CHECK(s.sensors.field_of_view_deg == 360);
  CHECK(s.obstacles.empty());
}

TEST_CASE("the streets come with the scenario") {
  const auto s = example::load();
  REQUIRE(s.world);
  CHECK(s.world->map.name() == "ring");
  CHECK(s.world->map.origin().utm_e_m == 571656);
  CHECK(s.world->map.origin().lat_deg == doctest::Approx(48.43236));
  CHECK(s.world->map.lanes().size() == 5);
  CHECK(s.world->map.buildings().size() == 1);
  REQUIRE(s.world->find("round_trip"));
  CHECK(s.world->find("round_trip")->closed());
  CHECK(s.world->find("round_trip")->length_m()
        == doctest::Approx(628.3).epsilon(0.001));
  CHECK_FALSE(s.world->find("straight")->closed());
}

TEST_CASE("a grid of providers is placed beside those that have a table each") {
  const auto s = example::load(
      example::text,
      {"provider_grid.columns=3", "provider_grid.rows=2",
       "provider_grid.first_m=[-100.0, 50.0]", "provider_grid.apart_m=200",
       "provider_grid.area_radius_m=90", "provider_grid.range_m=150"});
  REQUIRE(s.providers.size() == 8);
  const auto& east = s.providers[4]; // of the southern row
  CHECK(east.name == "mec_0_2");
  CHECK(east.position_m == point{300, 50});
  CHECK(east.area_radius_m == 90);
  CHECK(east.range_m == 150);
  CHECK(s.providers[7].name == "mec_1_2");
  CHECK(s.providers[7].position_m == point{300, 250});
  // What is printed of it can be loaded, and has each of them once.
  const auto again = example::load(to_toml(s));
  REQUIRE(again.providers.size() == 8);
  CHECK(again.providers[7].position_m == point{300, 250});
}

TEST_CASE("a provider may have a radio and a network of its own") {
  const auto s = example::load(example::with(
      "[network]", "radio = \"b\"\n[provider.network]\nprofile = \"ideal\"\n"
                   "more_delay = \"3ms\"\n[[provider.network.outage]]\n"
                   "from = \"1s\"\nto = \"2s\"\n\n[network]"));
  CHECK(s.providers[0].radio.empty());
  CHECK(s.channel_to(0) == s.network.channel);
  CHECK(s.providers[1].radio == "b");
  const auto& own = *s.channel_to(1);
  CHECK(own.name == "ideal");
  CHECK(own.more_delay == std::chrono::milliseconds{3});
  REQUIRE(own.outages.size() == 1);
  CHECK(own.outages[0].to == std::chrono::seconds{2});
  CHECK(s.network.channel->outages.empty());
  CHECK(s.profiles() == "paper_sim, ideal");
  CHECK(example::load().profiles() == "paper_sim");
  const auto again = example::load(to_toml(s));
  CHECK(to_toml(again) == to_toml(s));
  CHECK(again.channel_to(1)->outages.size() == 1);
}

TEST_CASE("fleets have computers, services say what a cycle asks of them") {
  const auto s = example::load(
      example::text,
      {"fleet.1.compute.clock_ghz=1.5",
       "service.trajectory_planning.compute.input_octets=40",
       "fleet.1.appear_every=10s", "fleet.1.fails_at=4min",
       "provider.mec.fails_at=5min", "provider.mec.returns_at=6min"});
  CHECK(s.fleets[0].compute.clock_ghz == 3);
  CHECK(s.fleets[1].compute.clock_ghz == 1.5);
  CHECK(s.services[0]->options.compute.input_octets == 40);
  CHECK(s.fleets[1].appear_every == std::chrono::seconds{10});
  CHECK(s.fleets[1].fails_at == std::chrono::minutes{4});
  CHECK_FALSE(s.fleets[0].fails_at.has_value());
  CHECK(s.providers[0].fails_at == std::chrono::minutes{5});
  CHECK(s.providers[0].returns_at == std::chrono::minutes{6});
  CHECK_FALSE(s.providers[1].fails_at.has_value());
  CHECK(to_toml(example::load(to_toml(s))) == to_toml(s));
}

TEST_CASE("vehicles may share a host, if it can carry the software of all") {
  CHECK(example::load().network.channel->vehicle_host.probability == 0);
  CHECK_FALSE(test::contains(to_toml(example::load()), "vehicle_host"));
  const auto with = [](const char* busy) {
    return example::load(example::text, {"vehicle_host.cores=4", busy});
  };
  const auto s = with("vehicle_host.busy_cores=0.4"); // 3.2 with 8 vehicles
  CHECK(s.vehicles() == 8);
  CHECK(s.network.channel->vehicle_host.probability > 0.5);
  CHECK(to_toml(example::load(to_toml(s))) == to_toml(s));
  CHECK_THROWS_WITH_AS(with("vehicle_host.busy_cores=0.5"),
                       doctest::Contains("asks for all 4 cores or more, with 8 "
                                         "vehicles"),
                       input_error);
}

TEST_CASE("without a provider there is nothing to offload to, but a scenario") {
  auto text = example::text;
  const auto from = text.find("[[provider]]");
  text.erase(from, text.find("[network]") - from);
  CHECK(example::load(text).providers.empty());
}

TEST_CASE("without a table of traffic the road grants crossings") {
  const auto text =
      example::with("[traffic]\ncrossings = \"perceived\"\n\n", "");
  CHECK(example::load(text).traffic.grants_crossings());
}

TEST_CASE("without policies the paper's decide") {
  auto text = example::text;
  const auto from = text.find("[policies]");
  text.erase(from, text.find("[record]") - from);
  const auto s = example::load(text);
  CHECK(s.policies.lodm->name() == "location");
  CHECK(s.policies.codm->name() == "location");
}

TEST_CASE("a measured trace is read with the scenario") {
  const auto s = example::load(
      example::with("profile = \"paper_sim\"",
                    "profile = \"trace\"\ntrace = \"delays.csv\""));
  CHECK(s.network.channel->replays);
  REQUIRE(s.network.channel->trace.size() == 3);
  CHECK(s.network.channel->trace[1].delay_s == doctest::Approx(0.014));
}

TEST_CASE("--set changes any option") {
  const auto s = example::load(
      example::text,
      {"seed=42", "duration=90s", "fleet.0.count=4", "name=other",
       "provider.0.area_radius_m=110", "provider.cloud.position_m=[1, 2.5]",
       "fleet.0.routes.1=round_trip", "policies.lodm.radius_m=200",
       "policies.codm.min_time=7s", "policies.codm.name=location",
       "record.tracks=false", "service.cabin_climate.max_latency=1s"});
  CHECK(s.seed == 42);
  CHECK(s.length == 90s);
  CHECK(s.name == "other");
  CHECK(s.fleets[0].count == 4);
  CHECK(s.fleets[0].routes[1] == "round_trip");
  CHECK(s.providers[0].area_radius_m == 110);
  CHECK(s.providers[1].position_m == point{1, 2.5});
  CHECK(s.services[1]->options.limits.max_latency == 1s);
  CHECK_FALSE(s.record.tracks);
  const auto text = to_toml(s);
  CHECK(text.find("radius_m = 200.0") != text.npos);
  CHECK(text.find("min_time = \"7s\"") != text.npos);
}

TEST_CASE("of two --set for one option the later counts") {
  CHECK(example::load(example::text, {"seed=1", "seed=2"}).seed == 2);
}

TEST_CASE("--set makes tables that the file does not have") {
  const auto text = example::with("[record]", "[policies.codm_]");
  CHECK(example::error_of(text).find("codm_") != std::string::npos);
  const auto bare = example::text.substr(0, example::text.find("[policies]"));
  const auto s =
      example::load(bare, {"policies.lodm=never", "record.tracks=false"});
  CHECK(s.policies.lodm->name() == "never");
  CHECK_FALSE(s.record.tracks);
}

TEST_CASE("the scenarios that come with the project can be loaded") {
  const std::filesystem::path config = SOFOF_SOURCE_DIR "/config";
  const auto ulm_lehr = load_scenario(config / "ulm_lehr.toml");
  CHECK(ulm_lehr.fleets.front().count == 6);
  CHECK(ulm_lehr.services.size() == 2);
  CHECK(ulm_lehr.providers.front().sensors.size() == 1);
  CHECK(ulm_lehr.world->map.lanes().size() > 2);
  const auto crossing = load_scenario(config / "occluded_crossing.toml");
  CHECK(crossing.fleets.size() == 2);
  CHECK(crossing.world->map.conflicts().size() == 1);
  const auto scale = load_scenario(config / "scale.toml");
  CHECK(scale.providers.size() == 10);
  CHECK(scale.length == 60s);
}

TEST_CASE("a limit that the scene sets is read with its cap and floor, and "
          "printed as it was") {
  const auto s = example::load(example::with(
      "max_latency = \"50ms\"", "max_latency = \"scene\"\nmax_latency_cap = "
                                "\"200ms\"\nmax_latency_floor = \"30ms\""));
  const auto& options = s.services[0]->options;
  CHECK(options.latency_by_scene);
  CHECK(options.limits.max_latency == 200ms);
  CHECK(options.latency_floor == 30ms);
  const auto text = to_toml(s);
  CHECK(text.find("max_latency = \"scene\"\nmax_latency_cap = \"200ms\"\n"
                  "max_latency_floor = \"30ms\"\n")
        != std::string::npos);
  CHECK_FALSE(
      example::load(example::text).services[0]->options.latency_by_scene);
}
