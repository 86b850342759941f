// The table of figures: whoever reads it finds each figure once.
#include "recording/figures.hpp"

#include "recording/safety_line.hpp"
#include "recording/summary.hpp"
#include "tests/support/made_up_run.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace sofof::made_up {

using namespace recording;

namespace {

nlohmann::json summary_of_a_run() {
  metrics m{run()};
  play(m);
  m.finish(at(100s));
  return nlohmann::json::parse(summary_json(m, run(), {100, 2, false}));
}

/// @returns whether an object has a member of this dotted name.
bool has(const nlohmann::json& object, std::string_view name) {
  auto path = '/' + std::string{name};
  std::ranges::replace(path, '.', '/');
  return object.contains(nlohmann::json::json_pointer{path});
}

template <class Figures, class Visit>
void each(const Figures& figures, Visit visit) {
  for (const auto& x : figures)
    visit(x);
}

template <class Visit>
void each_figure(Visit visit) {
  each(run_figures(), visit);
  each(service_figures(), visit);
  each(served_figures(), visit);
  each(vehicle_figures(), visit);
  each(run_cost_figures(), visit);
  each(clock_figures(), visit);
}

} // namespace

TEST_CASE("every figure stands in the summary under its name") {
  const auto summary = summary_of_a_run();
  const auto& service = summary["services"]["trajectory_planning"];
  const auto of = [](const nlohmann::json& where) {
    return [&where](const auto& x) {
      CAPTURE(x.name);
      CHECK(has(where, x.name));
    };
  };
  each(run_figures(), of(summary));
  each(service_figures(), of(summary));
  each(vehicle_figures(), of(summary));
  each(run_cost_figures(), of(summary));
  each(clock_figures(), of(summary));
  each(service_figures(), of(service));
  each(served_figures(), of(service));
  each(service_cost_figures(), of(service));
}

TEST_CASE("no figure has the name or the place of another one") {
  std::set<std::string_view> names;
  std::set<std::pair<report_table, int>> reported;
  std::set<std::pair<console_block, int>> shown;
  each_figure([&](const auto& x) {
    CAPTURE(x.name);
    CHECK(names.insert(x.name).second);
    if (x.report.in != report_table::none)
      CHECK(reported.emplace(x.report.in, x.report.place).second);
    if (x.console.in != console_block::none)
      CHECK(shown.emplace(x.console.in, x.console.place).second);
  });
}

TEST_CASE("what a service took has no name or place of another of its "
          "figures") {
  std::set<std::string_view> names;
  std::set<int> reported;
  const auto visit = [&](const auto& x) {
    CAPTURE(x.name);
    CHECK(names.insert(x.name).second);
    if (x.report.in == report_table::service)
      CHECK(reported.insert(x.report.place).second);
  };
  each(service_figures(), visit);
  each(served_figures(), visit);
  each(service_cost_figures(), visit);
}

TEST_CASE("what makes a run unsafe is told by the summary and the console") {
  const auto summary = summary_of_a_run();
  for (const auto& x : safety_line) {
    CAPTURE(x.name);
    CHECK(has(summary, x.name));
    const auto all = vehicle_figures();
    const auto found = std::ranges::find(all, x.name, &run_figure::name);
    REQUIRE(found != all.end());
    CHECK(found->console.in == console_block::safety);
  }
}

TEST_CASE("a run is safe if nothing of the line has happened") {
  CHECK(is_safe([](const std::string&) { return 0.; }));
  for (const auto& one : safety_line)
    CHECK_FALSE(is_safe([&one](const std::string& name) {
      return name == one.name ? 1. : 0.;
    }));
}

} // namespace sofof::made_up
