// The map of Ulm-Lehr: what it must be like to drive, and how close it is to
// the survey.
#include "tests/world/lehr.hpp"
#include "world/roads/road_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace sofof;
using namespace sofof::world;
using test::lehr;

namespace {

const std::vector<std::string> round_trips{"round_trip", "round_trip_opposite"};

constexpr point roundabout{-420, -132};

/// How the routes over the crossing enter and leave it.
const std::vector<std::string> manoeuvres{"west_to_east",  "east_to_west",
                                          "west_to_north", "east_to_north",
                                          "north_to_west", "north_to_east"};

template <class Function>
void walk(const route& way, double step_m, Function visit) {
  for (auto s_m = 0.0; s_m < way.length_m(); s_m += step_m)
    visit(s_m, way.path().at(s_m));
}

/// Time of a lap at the speed limits and at most 2.2 m/s^2 sideways, with or
/// without the time to change speed at 1.5 m/s^2.
double lap_s(const route& way, bool patient) {
  constexpr auto lateral_mps2 = 2.2, along_mps2 = 1.5, step_m = 1.0;
  std::vector<double> speeds;
  walk(way, step_m, [&](double s_m, const path_point& here) {
    const auto bend = std::max(std::abs(here.curvature_1pm), 1e-9);
    speeds.push_back(
        std::min(way.limit_mps(s_m), std::sqrt(lateral_mps2 / bend)));
  });
  const auto n = speeds.size();
  auto soften = [&](std::size_t from, std::size_t to) {
    speeds[to] = std::min(speeds[to], std::sqrt(speeds[from] * speeds[from]
                                                + 2 * along_mps2 * step_m));
  };
  for (std::size_t i = 0; patient && i < 2 * n; ++i) {
    soften(i % n, (i + 1) % n);
    soften((2 * n - i) % n, (2 * n - i - 1) % n);
  }
  auto time_s = 0.0;
  for (const auto v : speeds)
    time_s += way.length_m() / static_cast<double>(n) / v;
  return time_s;
}

/// Length of a route before, in and after a circle round the crossing, m.
struct cut {
  double before_m = 0, inside_m = 0, after_m = 0;
};

cut cut_by_circle(const route& way, double radius_m) {
  cut parts;
  walk(way, 0.1, [&](double, const path_point& here) {
    if (distance_m({}, here.at) <= radius_m)
      parts.inside_m += 0.1;
    else
      (parts.inside_m == 0 ? parts.before_m : parts.after_m) += 0.1;
  });
  return parts;
}

} // namespace

TEST_CASE("the round trips are closed and 2.8 km long") {
  const auto there = lehr().route("round_trip");
  const auto back = lehr().route("round_trip_opposite");
  CHECK(there->closed());
  CHECK(back->closed());
  CHECK(there->length_m() == doctest::Approx(2824).epsilon(0.001));
  CHECK(back->length_m() == doctest::Approx(2845).epsilon(0.002));
}

TEST_CASE("the round trip goes clockwise, the opposite one the other way") {
  auto turned = [](const route& way) {
    return way.path().at(way.length_m()).heading_rad
           - way.path().at(0).heading_rad;
  };
  CHECK(turned(*lehr().route("round_trip")) == doctest::Approx(-6.28319));
  CHECK(turned(*lehr().route("round_trip_opposite"))
        == doctest::Approx(6.28319));
}

TEST_CASE("everybody circulates counter-clockwise in the roundabout") {
  for (const auto& name : round_trips) {
    const auto& line = lehr().route(name)->path();
    const auto here = line.at(line.project(roundabout).s_m);
    const point ahead{std::cos(here.heading_rad), std::sin(here.heading_rad)};
    CHECK(cross(here.at - roundabout, ahead) > 8);
  }
}

TEST_CASE("a car can follow every route: gentle, continuous curvature") {
  for (const auto& way : lehr().routes) {
    CAPTURE(way->name());
    auto sharpest = 0.0, jump = 0.0, swerve = 0.0;
    auto last = way->path().at(0);
    walk(*way, 0.1, [&](double, const path_point& here) {
      sharpest = std::max(sharpest, std::abs(here.curvature_1pm));
      jump = std::max(jump, std::abs(here.curvature_1pm - last.curvature_1pm));
      swerve = std::max(swerve, std::abs(here.heading_rad - last.heading_rad));
      last = here;
    });
    CHECK(sharpest < 0.15);
    CHECK(jump < 0.003); // 0.03 1/m a metre
    CHECK(swerve < 0.02);
  }
}

TEST_CASE("curvature does not waver: few changes of sign a lap") {
  for (const auto& name : round_trips) {
    auto changes = 0;
    auto side = 0;
    walk(*lehr().route(name), 1, [&](double, const path_point& here) {
      const auto now = here.curvature_1pm > 0.002    ? 1
                       : here.curvature_1pm < -0.002 ? -1
                                                     : side;
      changes += now != side;
      side = now;
    });
    CHECK(changes < 40);
  }
}

TEST_CASE("a lap takes 205 to 220 s with 2.2 m/s^2 sideways") {
  for (const auto& name : round_trips) {
    const auto way = lehr().route(name);
    MESSAGE(name << ": " << lap_s(*way, false) << " s at the limits, "
                 << lap_s(*way, true) << " s with time to change speed");
    CHECK(lap_s(*way, false) < lap_s(*way, true));
    CHECK(lap_s(*way, true) > 205);
    CHECK(lap_s(*way, true) < 220);
  }
}

TEST_CASE("the speed limits are those of the places") {
  struct expectation {
    point at;
    double limit_mps;
  };
  const expectation places[]{{{-200, -61}, 8.33},   {{-30, -8}, 8.33},
                             {{113, -45}, 11.11},   {{42, -350}, 19.44},
                             {{-400, -622}, 19.44}, {{-855, -400}, 27.78},
                             {{-700, -162}, 16.67}};
  for (const auto& name : round_trips)
    for (const auto& [at, limit_mps] : places) {
      const auto way = lehr().route(name);
      const auto near = way->path().project(at);
      CHECK(std::abs(near.d_m) < 8);
      CHECK(way->limit_mps(near.s_m) == limit_mps);
    }
}

TEST_CASE("the two directions keep 3.5 m apart, left of each other") {
  const auto there = lehr().route("round_trip");
  const auto back = lehr().route("round_trip_opposite");
  auto least = 1e9, most = 0.0;
  walk(*back, 0.5, [&](double, const path_point& here) {
    const auto seen = there->path().project(here.at);
    least = std::min(least, seen.d_m);
    if (distance_m(here.at, roundabout) > 80)
      most = std::max(most, seen.d_m);
  });
  CHECK(least > 3.4);
  CHECK(most < 3.6);
}

TEST_CASE("the area round the crossing holds as much as the paper says") {
  CHECK(cut_by_circle(*lehr().route("round_trip"), 300).inside_m
        == doctest::Approx(687).epsilon(0.01));
  for (const auto& name : manoeuvres) {
    CAPTURE(name);
    const auto parts = cut_by_circle(*lehr().route(name), 110);
    CHECK(parts.inside_m > 209);
    CHECK(parts.inside_m < 226);
    CHECK(parts.before_m >= 100);
    CHECK(parts.after_m >= 100);
  }
}

TEST_CASE("conflicts lie at the pilot crossing only, and are the right ones") {
  std::set<std::string> found;
  for (const auto& c : lehr().map.conflicts()) {
    const auto& a = lehr().map.lanes()[c.lane_a];
    const auto& b = lehr().map.lanes()[c.lane_b];
    constexpr const char* kinds[]{"x", "merges", "diverges"};
    auto first = a.name, second = b.name;
    if (second < first)
      std::swap(first, second);
    found.insert(first + " " + kinds[static_cast<int>(c.how)] + " " + second);
    const auto at = path{a.centre}.at((c.from_a_m + c.to_a_m) / 2).at;
    CHECK(distance_m({}, at) < 60);
  }
  CHECK(found
        == std::set<std::string>{
            "east_to_north diverges east_to_west",
            "east_to_north merges west_to_north",
            "east_to_west merges north_to_west",
            "east_to_west x north_to_east",
            "east_to_west x west_to_north",
            "north_to_east diverges north_to_west",
            "north_to_east merges west_to_east",
            "north_to_east x west_to_north",
            "west_to_east diverges west_to_north",
        });
}

TEST_CASE("who comes from the north arm gives way, left turns likewise") {
  auto rank = [](std::string_view name) {
    return std::ranges::find(lehr().map.lanes(), name, &lane::name)->rank;
  };
  CHECK(rank("west_to_east") == 0);
  CHECK(rank("east_to_west") == 0);
  CHECK(rank("east_to_north") < rank("west_to_north"));
  CHECK(rank("west_to_north") < rank("north_to_west"));
  CHECK(rank("west_to_north") < rank("north_to_east"));
}

TEST_CASE("houses stand off the road") {
  CHECK(lehr().map.buildings().size() == 3);
  for (const auto& house : lehr().map.buildings()) {
    const polygon walls{house.corners};
    for (const auto& way : lehr().routes)
      walk(*way, 1, [&](double, const path_point& here) {
        CHECK_FALSE(walls.contains(here.at));
      });
    for (const auto& corner : house.corners)
      CHECK_FALSE(lehr().map.near_lanes({&corner, 1}, 4));
  }
}

TEST_CASE("the round trip passes through surveyed points") {
  // One every 235 m, from lehr_loop.csv; rounded to 1 cm.
  const point survey[]{
      {-67.21, -15.48},   {109.84, -85.96},   {43.83, -310.53},
      {70.28, -542.80},   {-111.70, -651.41}, {-345.36, -632.90},
      {-576.46, -578.26}, {-803.94, -531.04}, {-850.70, -336.34},
      {-748.91, -171.86}, {-515.48, -151.05}, {-291.66, -96.98}};
  for (const auto& p : survey)
    CHECK(std::abs(lehr().route("round_trip")->path().project(p).d_m) < 0.15);
}

TEST_CASE("the whole round trip stays within 0.15 m of the survey") {
  const std::string file =
      SOFOF_SOURCE_DIR "/../shared/data/ulm_lehr/lehr_loop.csv";
  if (!std::filesystem::exists(file)) {
    MESSAGE("SKIPPED: no survey at " << file);
    return;
  }
  const auto& origin = lehr().map.origin();
  std::ifstream in{file};
  std::string line;
  std::getline(in, line);
  std::vector<point> survey;
  auto wrong_limits_m = 0.0;
  const auto way = lehr().route("round_trip");
  for (auto last_s_m = 0.0; std::getline(in, line);) {
    for (auto& c : line)
      c = c == ',' ? ' ' : c;
    std::istringstream fields{line};
    double s_m, e_m, n_m, left_m, right_m, limit_mps;
    fields >> s_m >> e_m >> n_m >> left_m >> right_m >> limit_mps;
    survey.push_back({e_m - origin.utm_e_m, n_m - origin.utm_n_m});
    const auto at_m = way->path().project(survey.back()).s_m;
    if (way->limit_mps(at_m) != limit_mps)
      wrong_limits_m += s_m - last_s_m;
    last_s_m = s_m;
  }
  survey.push_back(survey.front());
  REQUIRE(survey.size() > 5000);
  CHECK(wrong_limits_m < 15);
  auto off_m = 0.0;
  for (const auto& p : survey)
    off_m = std::max(off_m, std::abs(way->path().project(p).d_m));
  auto away_m = 0.0;
  walk(*way, 5, [&](double, const path_point& here) {
    auto nearest = 1e9;
    for (std::size_t i = 1; i < survey.size(); ++i)
      nearest = std::min(
          nearest, distance_to_segment_m(here.at, survey[i - 1], survey[i]));
    away_m = std::max(away_m, nearest);
  });
  MESSAGE("survey to map " << off_m << " m, map to survey " << away_m << " m");
  CHECK(off_m < 0.15);
  CHECK(away_m < 0.15);
}
