// Small scenarios of CommonRoad, put together for a test.
#pragma once

#include "experiments/judge/judge.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sofof::judging {

/// Two lanes side by side, 400 m from west to east; the right one, "1", has
/// its middle at y = 0, the left one, "2", at y = 3.5.
struct made_scene {
  double speed_mps = 10;
  double start_x_m = 30, start_y_m = 0;
  int first = 0, last = 60; ///< Of the goal, steps.
  double goal_x_m = 80, goal_y_m = 0;
  std::string more_of_goal{}, obstacles{};

  std::string text() const {
    return fmt::format(
        R"(<?xml version="1.0"?>
<commonRoad commonRoadVersion="2020a" benchmarkID="ZAM_Made-1_1_T-1" timeStepSize="0.1">
{}{}
<trafficSign id="9"><trafficSignElement><trafficSignID>274</trafficSignID><additionalValue>13.89</additionalValue></trafficSignElement></trafficSign>
{}
<planningProblem id="7">{}
<goalState><position><rectangle><length>10</length><width>3.5</width><center><x>{}</x><y>{}</y></center></rectangle></position>
<time><intervalStart>{}</intervalStart><intervalEnd>{}</intervalEnd></time>{}</goalState></planningProblem>
</commonRoad>)",
        lanelet(1, 0), lanelet(2, 3.5), obstacles,
        state("initialState", 0, start_x_m, start_y_m, speed_mps), goal_x_m,
        goal_y_m, first, last, more_of_goal);
  }

  static std::string lanelet(int id, double y_m) {
    const auto bound = [y_m](const char* name, double left_m) {
      return fmt::format("<{0}><point><x>0</x><y>{1}</y></point><point><x>400"
                         "</x><y>{1}</y></point></{0}>",
                         name, y_m + left_m);
    };
    return fmt::format("<lanelet id=\"{}\">{}{}<trafficSignRef ref=\"9\"/>"
                       "</lanelet>\n",
                       id, bound("leftBound", 1.75),
                       bound("rightBound", -1.75));
  }

  static std::string state(const char* name, int step, double x_m, double y_m,
                           double speed_mps) {
    return fmt::format(
        "<{0}><position><point><x>{1}</x><y>{2}</y></point></position>"
        "<orientation><exact>0</exact></orientation><time><exact>{3}</exact>"
        "</time><velocity><exact>{4}</exact></velocity></{0}>",
        name, x_m, y_m, step, speed_mps);
  }

  /// Adds somebody who drives along at constant speed.
  void add_driver(double x_m, double y_m, double speed_mps, int from = 0) {
    obstacles += "<dynamicObstacle id=\"50\"><shape><rectangle><length>4.5"
                 "</length><width>1.8</width></rectangle></shape>"
                 + state("initialState", from, x_m, y_m, speed_mps)
                 + "<trajectory>";
    for (auto k = 1; k <= 200; ++k)
      obstacles +=
          state("state", from + k, x_m + 0.1 * k * speed_mps, y_m, speed_mps);
    obstacles += "</trajectory></dynamicObstacle>\n";
  }
};

/// Judges it, with a folder for files.
struct judged_scene {
  test::scratch folder;
  std::vector<experiments::judge::judged> rows;

  explicit judged_scene(const std::string& text) {
    test::write_text(folder / "made.xml", text);
    experiments::judge::judge by{{.out = folder.path(), .changes = {}}};
    rows = by.look_at((folder / "made.xml").string());
  }

  std::string text_of(const std::string& name) const {
    return test::read_file(folder / name);
  }

  /// @returns the names of the files that are there, in order.
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& one : std::filesystem::directory_iterator{folder.path()})
      all.push_back(one.path().filename().string());
    std::ranges::sort(all);
    return all;
  }

  const experiments::judge::judged& only() const {
    REQUIRE(rows.size() == 1);
    INFO(rows.front().found.why);
    return rows.front();
  }
};

} // namespace sofof::judging
