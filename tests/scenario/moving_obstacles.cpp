// Obstacles that move, and vehicles that start beside their lane.
#include "scenario/placement.hpp"
#include "tests/scenario/example.hpp"
#include "tests/scenario/whole_run.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>

namespace sofof::moving_obstacles {

using namespace scenario;

namespace {

constexpr std::string_view lorry =
    "[[obstacle]]\nlength_m = 8\nmoment = [\n"
    "  { t_s = 0, position_m = [1, 2], heading_deg = 90, speed_mps = 3 },\n"
    "  { t_s = 2, position_m = [1, 8] },\n]\n";

scenario_definition with_obstacles(const std::string& text) {
  return example::load(example::with("[network]", text + "[network]"));
}

std::string error_of(const std::string& text) {
  return example::error_of(example::with("[network]", text + "[network]"));
}

} // namespace

TEST_CASE("an obstacle with moments moves") {
  const auto s = with_obstacles(std::string{lorry});
  REQUIRE(s.obstacles.size() == 1);
  const auto& one = s.obstacles.front();
  CHECK(one.moves());
  const auto body = one.script(5).at(0);
  REQUIRE(body);
  CHECK(body->id == 5);
  CHECK(body->box.centre == point{1, 2});
  CHECK(body->box.heading_rad == doctest::Approx(std::numbers::pi / 2));
  CHECK(body->box.length_m == 8);
  CHECK(body->speed_mps == 3);
}

TEST_CASE("what obstacles and starts say is printed and read again") {
  auto s = with_obstacles(std::string{lorry}
                          + "[[obstacle]]\nposition_m = [5, 6]\n");
  s.fleets.front().start_left_m = 0.5;
  s.fleets.front().start_turn_deg = -3;
  s.fleets.front().start_over_limit = true;
  const auto text = to_toml(s);
  CHECK(to_toml(example::load(text)) == text);
  CHECK(text.find("start_left_m = 0.5\n") != text.npos);
  CHECK(to_toml(example::load()).find("start_left_m") == std::string::npos);
}

TEST_CASE("moments that do not rise are refused") {
  const auto late =
      error_of("[[obstacle]]\nmoment = [{ t_s = 1 }, { t_s = 1 }]\n");
  CHECK(late.find("must be in rising order of t_s") != late.npos);
  CHECK(error_of("[[obstacle]]\nmoment = [{ t_s = -1 }]\n").find("t_s")
        != std::string::npos);
  CHECK(error_of("[[obstacle]]\nmoment = []\n").empty());
}

TEST_CASE("a vehicle starts faster than is allowed where its file says so") {
  const std::string fast = "start_speed_mps = 30.0";
  const auto text = example::with("start_speed_mps = 8.5", fast);
  CHECK(example::error_of(text).find("where the limit is") != text.npos);
  CHECK(example::error_of(example::with("start_speed_mps = 8.5",
                                        fast + "\nstart_over_limit = true"))
        == "");
}

TEST_CASE("a vehicle starts beside its lane and turned from it") {
  auto s = example::load();
  const auto before = place_vehicles(s).front().body();
  s.fleets.front().start_left_m = 1;
  s.fleets.front().start_turn_deg = 90;
  const auto body = place_vehicles(s).front().body();
  CHECK(wrap_angle(body.heading_rad - before.heading_rad)
        == doctest::Approx(std::numbers::pi / 2));
  const auto records = [&s] {
    auto brief = s;
    brief.length = std::chrono::milliseconds{100};
    brief.record.tracks_period = std::chrono::milliseconds{10};
    return test::play(brief);
  }();
  REQUIRE(!records.tracks.empty());
  CHECK(records.tracks.front().lateral_m == doctest::Approx(1).epsilon(0.05));
}

TEST_CASE("a vehicle sees an obstacle that comes, and touches it") {
  auto s = example::load();
  s.length = std::chrono::seconds{1};
  REQUIRE(test::play(s).collisions.empty());
  const auto first = place_vehicles(s).front().body();
  obstacle_options one;
  one.moments = {{0.5, {1000, 1000}}, {0.6, first.centre}, {2, first.centre}};
  s.obstacles = {{{900, 900}}, one, {{950, 950}}};
  const auto records = test::play(s);
  REQUIRE(records.collisions.size() == 1);
  const auto& touch = records.collisions.front();
  CHECK(touch.second == obstacle_id(2)); // behind those that stand
  CHECK(touch.at == time_point{std::chrono::milliseconds{600}});
}

} // namespace sofof::moving_obstacles
