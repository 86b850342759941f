// What a report says of a chain: who ran what, and how late vehicles responded.
#include "experiments/report/admitted_times.hpp"
#include "experiments/report/chain_section.hpp"
#include "experiments/report/describe.hpp"
#include "experiments/report/html.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/report_document.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::report {

using namespace made_up;
using test::contains;

namespace {

/// One vehicle, 101, whose planning is at the provider "mec" from 2 to 6 s, and
/// its tracking, too, from 3 to 5 s, which then falls back.
class chain_folder : public played_folder {
public:
  chain_folder() {
    spoil("config.toml", "[[service]]\nname = \"trajectory_planning\"\n",
          "[[service]]\nname = \"tracking\"\n"
          "[[service]]\nname = \"environment_model\"\n"
          "[[service]]\nname = \"trajectory_planning\"\n");
    write("responses.csv",
          "t_s,station,split,response_ms,waited_ms,services_ms,control_ms\n"
          "0.5,101,vehicle>vehicle>vehicle,60,0,10 10 30,10\n"
          "4,101,mec>vehicle>mec,150,0,60 10 70,10\n"
          "8,101,vehicle>vehicle>vehicle,40,0,10 10 10,10\n");
    write("scene.csv", "t_s,station,service,safe_ms,because,response_ms\n"
                       "0.5,101,tracking,5000,free,\n"
                       "1,101,tracking,5000,free,\n"
                       "4,101,tracking,0,follow,\n"
                       "8,101,tracking,0,follow,\n"
                       "8,101,cabin_climate,7,follow,\n");
    write("events.jsonl", switched_at(2, "trajectory_planning", "remote")
                              + switched_at(3, "tracking", "remote")
                              + switched_at(5, "tracking", "local")
                              + switched_at(6, "trajectory_planning", "local"));
    write("episodes.csv",
          "provider,service,provider_id,station,counter,side,accepted_s,"
          "first_data_s,ended_s,t_off_s,reason,fallback\n"
          "mec,tracking,1,101,1,requester,2.5,3,5,2,qos_gap,1\n"
          "mec,trajectory_planning,1,101,2,requester,1.5,2,6,4,released,0\n"
          "mec,tracking,1,101,1,provider,2.5,,5,,qos_gap,1\n");
  }

private:
  static std::string switched_at(int t_s, std::string_view service,
                                 std::string_view to) {
    return nlohmann::json{{"t_s", t_s},       {"what", "switch"},
                          {"station", 101},   {"provider", "mec"},
                          {"provider_id", 1}, {"service", service},
                          {"counter", 1},     {"detail", to}}
               .dump()
           + "\n";
  }
};

section chain_of(const played_folder& folder) {
  for (auto& x : describe_run(folder.path()))
    if (x.title == "Chain")
      return x;
  return {};
}

const curve& curve_called(const figure& in, std::string_view name) {
  const auto found = std::ranges::find(in.curves, name, &curve::name);
  REQUIRE(found != in.curves.end());
  return *found;
}

/// In ms, in the vehicle and at a provider: docs/chain.md.
constexpr double tracking_ms[]{10, 560}, planning_ms[]{95, 645};
constexpr double model_ms = 15;

} // namespace

TEST_CASE("a run without a chain says nothing of one") {
  const played_folder folder;
  folder.write("responses.csv", "t_s,station,response_ms\n1,101,50\n");
  CHECK(chain_of(folder).blocks.empty());
  const auto all =
      document_in(html(describe(std::vector{folder.path()}, "1"))).dump();
  for (const auto* key : {"\"strips\"", "\"log_y\"", "\"means\"", "\"chain\""})
    CHECK_FALSE(contains(all, key));
}

TEST_CASE(
    "each service of a chain has a strip: at home, there, at home again") {
  const chain_folder folder;
  const auto all = chain_of(folder);
  REQUIRE(all.blocks.size() == 1);
  const auto& shown = std::get<figure>(all.blocks[0]);
  REQUIRE(shown.strips.size() == 3);
  CHECK(shown.strips[0].name == "tracking");
  CHECK(shown.strips[2].name == "trajectory_planning");
  REQUIRE(shown.places.size() == 2);
  CHECK_FALSE(shown.places[0].second);
  CHECK(shown.places[1].first == "mec");
  CHECK(shown.places[1].second == 0);
  const auto stays_of = [&](std::size_t k) {
    std::vector<std::vector<double>> stays;
    for (const auto& x : shown.strips[k].stays) {
      CHECK(x.station == 101);
      stays.push_back({x.from, x.until, static_cast<double>(x.place)});
    }
    return stays;
  };
  using stays = std::vector<std::vector<double>>;
  CHECK(stays_of(0) == stays{{0.5, 3, 0}, {3, 5, 1}, {5, 8.04, 0}});
  CHECK(stays_of(1) == stays{{0.5, 8.04, 0}});
  CHECK(stays_of(2) == stays{{0.5, 2, 0}, {2, 6, 1}, {6, 8.04, 0}});
}

TEST_CASE("a fallback of a service is marked on its strip, once") {
  const chain_folder folder;
  const auto all = chain_of(folder);
  const auto& strips = std::get<figure>(all.blocks.at(0)).strips;
  REQUIRE(strips.at(0).fallbacks.size() == 1);
  CHECK(strips[0].fallbacks[0].station == 101);
  CHECK(strips[0].fallbacks[0].x == 5);
  CHECK(strips.at(2).fallbacks.empty());
}

TEST_CASE("each response is a point; the scene's allowance is told where it "
          "changes, and in the end") {
  const chain_folder folder;
  const auto all = chain_of(folder);
  const auto& shown = std::get<figure>(all.blocks.at(0));
  CHECK(shown.by_clock);
  CHECK(shown.log_y);
  const auto& points = curve_called(shown, "measured");
  CHECK(points.x == std::vector<double>{0.5, 4, 8});
  CHECK(points.y == std::vector<double>{60, 150, 40});
  CHECK(points.stations == std::vector<double>{101, 101, 101});
  const auto& scene = curve_called(shown, "allowed by the scene");
  CHECK(scene.x == std::vector<double>{0.5, 4, 8});
  CHECK(scene.y == std::vector<double>{5000, 0, 0});
}

TEST_CASE(
    "what a split's limits admit follows the services, wherever they go") {
  const chain_folder folder;
  const auto all = chain_of(folder);
  const auto& limits = curve_called(std::get<figure>(all.blocks.at(0)),
                                    "admitted by the split's limits");
  CHECK(limits.dashed);
  CHECK(limits.x == std::vector<double>{0.5, 2, 3, 5, 6, 8.04});
  const auto sum = [](bool tracking, bool planning) {
    return tracking_ms[tracking] + model_ms + planning_ms[planning];
  };
  const std::vector expected{sum(false, false), sum(false, true),
                             sum(true, true),   sum(false, true),
                             sum(false, false), sum(false, false)};
  REQUIRE(limits.y.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(limits.y[i] == doctest::Approx(expected[i]));
}

TEST_CASE("a run that was told to write no responses shows the rest") {
  const chain_folder folder;
  std::filesystem::remove(folder.path() / "responses.csv");
  const auto all = chain_of(folder);
  const auto& shown = std::get<figure>(all.blocks.at(0));
  CHECK(shown.strips.size() == 3);
  CHECK(shown.curves.size() == 2);
  CHECK_FALSE(contains(shown.caption, "Measured"));
}

TEST_CASE("where no policy asked what the scene allows, the report says so") {
  const chain_folder folder;
  std::filesystem::remove(folder.path() / "scene.csv");
  const auto all = chain_of(folder);
  const auto& shown = std::get<figure>(all.blocks.at(0));
  CHECK(shown.curves.size() == 2);
  CHECK(contains(shown.caption, "No policy asked"));
}

TEST_CASE(
    "where the vehicle's functions may take forever, no split is limited") {
  const chain_folder folder;
  folder.spoil("config.toml", "routes = [\"block *\"]\n",
               "routes = [\"block *\"]\n[fleet.compute]\n"
               "scheduling = \"fixed_priority\"\ncores = 1\n"
               "clock_ghz = 0.1\n");
  const auto all = chain_of(folder);
  const auto& shown = std::get<figure>(all.blocks.at(0));
  CHECK(shown.curves.size() == 2);
  CHECK_FALSE(contains(shown.caption, "Admitted"));
}

TEST_CASE("a station of no fleet has no limits") {
  const chain_folder folder;
  const admitted_times times{open_run(folder.path()).what};
  CHECK(times.of(101, {false, false, false}) == 120ms);
  CHECK_FALSE(times.of(100, {false, false, false}));
  CHECK_FALSE(times.of(103, {false, false, false}));
}

TEST_CASE("the page gets strips with their places, and knows the chain") {
  const chain_folder folder;
  const auto sections =
      document_in(html(describe(std::vector{folder.path()}, "1")))["sections"];
  const auto section_called = [&](std::string_view title) {
    for (const auto& x : sections)
      if (x["title"] == title)
        return x;
    FAIL("there is no section ", title);
    return nlohmann::json{};
  };
  const auto block = section_called("Chain")["blocks"][0];
  CHECK(block["log_y"] == true);
  CHECK(block["places"][1]["provider"] == 0);
  CHECK_FALSE(block["places"][0].contains("provider"));
  CHECK(block["strips"][0]["fallbacks"][0] == nlohmann::json{101, 5});
  CHECK(block["curves"][0]["means"] == "measured");
  CHECK(section_called("Drive")["blocks"][0]["chain"][2]
        == "trajectory_planning");
}

} // namespace sofof::experiments::report
