// The effective configuration as a file.
#include "base/options/option_printer.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_text.hpp"
#include "tests/scenario/example.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <limits>
#include <sstream>
#include <vector>

using namespace sofof;
using namespace sofof::scenario;
using namespace std::chrono_literals;

namespace {

/// One option of every type.
struct everything {
  bool flag = false;
  double number_m = 0.1;
  std::int64_t count = 3;
  std::string text = "text";
  duration time = 50ms;
  std::vector<std::string> names;
  point at;
  std::vector<point> line;
  std::vector<std::int64_t> parts;

  void visit_options(option_visitor& s) {
    s.table("inner", [this](option_visitor& t) {
      t.field("at", at);
      t.field("line", line);
    });
    s.tables("part", parts.size(), [this](std::size_t i, option_visitor& t) {
      if (i == parts.size())
        parts.emplace_back();
      t.field("number", parts[i], {});
    });
    s.field("flag", flag);
    s.field("number_m", number_m);
    s.field("count", count, {});
    s.field("text", text);
    s.field("time", time, 0ns);
    s.field("names", names);
  }

  friend bool operator==(const everything&, const everything&) = default;
};

everything unusual() {
  return {.flag = true,
          .number_m = 1.0 / 3,
          .count = std::numeric_limits<std::int64_t>::min(),
          .text = "tab\t, \"quotes\", C:\\folder,\nline, Straße, \x01\x7f",
          .time = 1s + 1ns,
          .names = {"", "a, b"},
          .at = {-0.0, 1e-9},
          .line = {{1, 2}, {3.5, -4e6}},
          .parts = {1, 2, 3}};
}

/// A circle and a polygon.
std::vector<channel::network_area> areas() {
  std::vector<channel::network_area> all(2);
  all[0].name = "hole";
  all[0].position_m = {1, 2};
  all[0].quality = {30ms, 2, 0.1};
  all[1].area_m = {{0, 0}, {1, 0}, {1, 1}};
  all[1].quality.loss = 1;
  return all;
}

template <class T>
std::string print(T x) {
  return print_options([&](option_visitor& s) { x.visit_options(s); });
}

template <class T>
T read(const std::string& text) {
  T x;
  toml_file{text, "printed"}.read(
      [&](option_visitor& s) { x.visit_options(s); });
  return x;
}

} // namespace

TEST_CASE("printed options read well") {
  everything x;
  x.parts = {7};
  CHECK(print(x) == R"(flag = false
number_m = 0.1
count = 3
text = "text"
time = "50ms"
names = []

[inner]
at = [0.0, 0.0]
line = []

[[part]]
number = 7
)");
}

TEST_CASE("printed options load again to the same") {
  CHECK(read<everything>(print(everything{})) == everything{});
  CHECK(read<everything>(print(unusual())) == unusual());
}

TEST_CASE("every number survives being printed") {
  for (const auto x : {0.1, 1e16, 1e22, 5e-324, 9.9e299, -2.5, 300.0, 1e5,
                       123456789012345680.0}) {
    everything e;
    e.number_m = x;
    CAPTURE(x);
    CHECK(read<everything>(print(e)).number_m == x);
  }
}

TEST_CASE("a whole number of a quantity is printed as a quantity") {
  CHECK(number_text(300) == "300.0");
  CHECK(number_text(1e22) == "1e+22");
}

TEST_CASE("the effective configuration loads again to itself") {
  auto all = example::load();
  all.obstacles.push_back({{1, 2}, 3, 4, 5});
  all.providers.front().sensors.push_back({{1, 2}, 3, {.range_m = 7}});
  all.network.profile.areas = areas();
  all.policies.forecast.source = "learned";
  all.policies.forecast.shared = true;
  const auto text = to_toml(all);
  const auto again = example::load(text);
  CHECK(to_toml(again) == text);
  CHECK(again.providers[1].area_m == example::load().providers[1].area_m);
  CHECK(again.policies.codm->name() == "always");
}

TEST_CASE("the effective configuration names the defaults too") {
  const auto text = to_toml(example::load());
  for (const auto line :
       {"area_corners = 24\n", "range_m = 2000.0\n", "map = \"ring.toml\"\n",
        "duration = \"10min\"\n", "min_distance_m = 50.0\n", "tracks = true\n",
        "workers = 1\n", "[sensors]\n", "occlusion = true\n",
        "[policies.lodm]\n", "[[service]]\n"}) {
    CAPTURE(line);
    CHECK(text.find(line) != text.npos);
  }
}

TEST_CASE("every option stands in the documentation") {
  const auto docs = read_text(SOFOF_SOURCE_DIR "/docs/scenarios.md");
  REQUIRE(docs);
  auto all = example::load();
  all.grid = true;
  all.obstacles.emplace_back();
  all.obstacles.emplace_back().moments.emplace_back();
  all.fleets.front().start_left_m = all.fleets.front().start_turn_deg = 1;
  all.fleets.front().start_over_limit = true;
  all.fleets.front().compute.scheduling = core_order::edf;
  all.providers.front().sensors.emplace_back();
  all.network.profile.areas = areas();
  all.policies.forecast.source = "file";
  all.policies.forecast.file = "quality.csv";
  std::istringstream lines{to_toml(all)};
  auto options = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto key = line.substr(0, line.find(" = "));
    if (key.empty() || key.starts_with('['))
      continue;
    CAPTURE(key);
    const auto alone = docs->find("`" + key + "`") != docs->npos;
    CHECK((alone || docs->find("." + key + "`") != docs->npos));
    ++options;
  }
  CHECK(options > 50);
}

TEST_CASE("what --set changed stands in the effective configuration") {
  const auto text =
      to_toml(example::load(example::text, {"provider.mec.area_radius_m=110"}));
  CHECK(text.find("area_radius_m = 110.0\n") != text.npos);
}
