// Speed, offloaded vehicles and t_off by time.
#include "experiments/report/over_time.hpp"
#include "tests/experiments/report_folder.hpp"
#include "tests/experiments/report_sections.hpp"

#include <array>
#include <filesystem>
#include <vector>

namespace sofof::experiments::report {

using made_up::played_folder;

namespace {

section told_of(std::span<const std::filesystem::path> folders) {
  return over_time(open_runs(folders));
}

} // namespace

TEST_CASE("each second has a mean speed, and a share of offloaded vehicles") {
  const played_folder folder;
  folder.write("tracks.csv",
               "t_s,station,x_m,y_m,heading_rad,speed_mps,source\n"
               "0.1,101,0,0,0,4,local\n0.1,102,9,0,0,8,remote\n"
               "1.1,101,4,0,0,6,remote\n1.2,102,9,0,0,6,remote\n");
  const std::array folders{folder.path()};
  const auto all = told_of(folders);
  const auto& speed = std::get<figure>(all.blocks.at(0));
  REQUIRE(speed.curves.size() == 1);
  CHECK(speed.curves[0].x == std::vector<double>{0, 1});
  CHECK(speed.curves[0].y == std::vector<double>{6, 6});
  CHECK(speed.curves[0].low == std::vector<double>{4, 6});
  CHECK(speed.curves[0].high == std::vector<double>{8, 6});
  const auto& share = std::get<figure>(all.blocks.at(1));
  CHECK(share.curves.at(0).y == std::vector<double>{50, 100});
}

TEST_CASE("t_off is a point for each episode that had data, where it ended") {
  const played_folder folder;
  const std::array folders{folder.path()};
  const auto all = told_of(folders);
  const auto& times = std::get<figure>(all.blocks.at(2));
  CHECK(times.title == "t_off by end, trajectory_planning");
  REQUIRE(times.curves.size() == 1);
  const auto& at_mec = times.curves[0];
  CHECK(at_mec.name == "mec");
  CHECK(at_mec.provider == 0);
  REQUIRE(at_mec.x.size() >= 2);
  CHECK(at_mec.x[0] == 30);
  CHECK(at_mec.y[0] == 20);
  CHECK(at_mec.y[1] == 5);
}

TEST_CASE("of several runs each has a curve, without a band") {
  const played_folder one{"one"}, other{"other"};
  const std::array folders{one.path(), other.path()};
  const auto all = told_of(folders);
  const auto& speed = std::get<figure>(all.blocks.at(0));
  REQUIRE(speed.curves.size() == 2);
  CHECK(speed.curves[1].name == "other");
  CHECK(speed.curves[1].low.empty());
}

} // namespace sofof::experiments::report
