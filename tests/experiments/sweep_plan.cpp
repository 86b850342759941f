// What a sweep file says, and what is said about a wrong one.
#include "base/input_error.hpp"
#include "experiments/sweep/plan.hpp"
#include "tests/support/mistakes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::test;

namespace {

const std::string text = R"(name = "both"
scenario = "base.toml"
seeds = [3, 5]

[set]
duration = "10s"
service.trajectory_planning.period = "20ms"

[[axis]]
name = "vehicles"
key = "fleet.0.count"
values = [1, 6]

[[axis]]
name = "way"
[[axis.value]]
name = "east"
set = { "fleet.0.routes" = ["west_to_east"], "fleet.0.start_m" = 10.5 }
[[axis.value]]
name = "north"
set = { "fleet.0.routes" = ["east_to_north"] }
)";

sweep_plan parsed(const std::string& from,
                  const std::vector<std::string>& overrides = {}) {
  return parse_sweep(from, "some/where.toml", overrides);
}

std::string changed(std::string_view right, std::string_view wrong) {
  auto all = text;
  const auto at = all.find(right);
  REQUIRE(at != all.npos);
  return all.replace(at, right.size(), wrong);
}

std::string error_of(const std::string& from,
                     const std::vector<std::string>& overrides = {}) {
  try {
    parsed(from, overrides);
  } catch (const input_error& problem) {
    return problem.what();
  }
  return "no error";
}

} // namespace

TEST_CASE("a sweep is the product of its axes and seeds, seeds fastest") {
  const auto plan = parsed(text);
  CHECK(plan.name == "both");
  CHECK(plan.scenario == "some/base.toml");
  CHECK(plan.size() == 8);
  const auto points = points_of(plan);
  REQUIRE(points.size() == 8);
  CHECK(points[0].labels == std::vector<std::string>{"1", "east"});
  CHECK(points[0].seed == 3);
  CHECK(points[1].seed == 5);
  CHECK(points[2].labels == std::vector<std::string>{"1", "north"});
  CHECK(points[4].labels == std::vector<std::string>{"6", "east"});
  CHECK(describe(plan, points[7]) == "vehicles=6, way=north, seed=5");
}

TEST_CASE("a point is the base, what all change, and its own values") {
  const auto points = points_of(parsed(text, {"network.profile=ideal"}));
  CHECK(points[0].given
        == std::vector<std::string>{
            R"(duration="10s")", R"(service.trajectory_planning.period="20ms")",
            "network.profile=ideal", "fleet.0.count=1",
            R"(fleet.0.routes=[ "west_to_east" ])", "fleet.0.start_m=10.5",
            "seed=3"});
}

TEST_CASE("a number of seeds is all seeds up to it") {
  const auto plan = parsed(changed("[3, 5]", "4"));
  CHECK(plan.seeds == std::vector<std::int64_t>{1, 2, 3, 4});
}

TEST_CASE("without axes a sweep is its seeds") {
  const auto plan = parsed("name = 'a'\nscenario = 'b.toml'\nseeds = 3");
  CHECK(points_of(plan).size() == 3);
  CHECK(points_of(plan)[2].given == std::vector<std::string>{"seed=3"});
}

TEST_CASE("each combination of values may have seeds of its own") {
  auto plan = parsed(changed("[3, 5]", "[3, 5]\nmost_seeds = 4"));
  CHECK(plan.most_seeds_of(0) == 4);
  const auto combinations = plan.combinations();
  CHECK(plan.size() == 2 * combinations);
  plan.seeds_of.assign(combinations, 1);
  plan.seeds_of.front() = 4;
  CHECK(plan.size() == combinations + 3);
  const auto points = points_of(plan);
  REQUIRE(points.size() == plan.size());
  CHECK(points[0].seed == 3);
  CHECK(points[1].seed == 5);
  CHECK(points[2].seed == 6);
  CHECK(points[3].seed == 7);
  CHECK(points[3].labels == points[0].labels);
  CHECK(points[4].labels != points[0].labels);
  CHECK(parsed(text).most_seeds_of(0) == 2);
}

TEST_CASE("each value of the first axis may have a most of its own") {
  const auto plan = parsed(changed("[3, 5]", "[3, 5]\nmost_seeds = [9, 4]"));
  const auto points = points_of(plan);
  for (std::size_t i = 0; i < plan.combinations(); ++i)
    CHECK(plan.most_seeds_of(i)
          == (points[i * plan.seeds.size()].labels[0] == "1" ? 9 : 4));
}

TEST_CASE("what seeds draw varies over them, and over nothing else") {
  const auto plan = parsed("name = 'a'\nscenario = 'b.toml'\nseeds = 200\n"
                           "[[draw]]\nkey = 'x'\nfrom = 2\nto = 3.5\n"
                           "[[draw]]\nkey = 'y'\nvalues = [['a'], ['b', 'c']]\n"
                           "[[axis]]\nkey = 'z'\nvalues = [1, 2]\n");
  const auto points = points_of(plan);
  REQUIRE(points.size() == 400);
  double least = 10, most = 0;
  int first = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const auto& given = points[i].given;
    REQUIRE(given.size() == 4);
    CHECK(given[1] == points[i + 200].given[1]);
    CHECK(given[2] == points[i + 200].given[2]);
    const auto x = std::stod(given[1].substr(2));
    least = std::min(least, x);
    most = std::max(most, x);
    first += given[2] == "y=[ \"a\" ]" || given[2] == "y=[ 'a' ]" ? 1 : 0;
  }
  CHECK(least >= 2);
  CHECK(least < 2.1);
  CHECK(most <= 3.5);
  CHECK(most > 3.4);
  CHECK(first > 70);
  CHECK(first < 130);
}

TEST_CASE("a mistake in a sweep file is named with its place") {
  const mistake mistakes[] = {
      {"seeds = [3, 5]", "seeds = [3, 5]\nmost_seeds = @1", {"from 2"}},
      {"seeds = [3, 5]",
       "seeds = [3, 5]\nmost_seeds = @[4]",
       {"each of the 2 values"}},
      {"seeds = [3, 5]", "seeds = [3, 5]\nmost_seeds = [4, @1]", {"from 2"}},
      {"seeds = [3, 5]", "seeds = [3, 5]\ndraw = @1", {"draw", "tables"}},
      {"seeds = [3, 5]",
       "seeds = [3, 5]\ndraw = [{key='a', from=1, to=@1}]",
       {"more than from"}},
      {"seeds = [3, 5]",
       "seeds = [3, 5]\ndraw = [{key='a', values=@[]}]",
       {"values", "list"}},
      {"seeds = [3, 5]", "seeds = @[]", {"seeds", "list"}},
      {"seeds = [3, 5]", "seeds = @0", {"from 1 to"}},
      {"seeds = [3, 5]", "seeds = [3, @3]", {"seed 3", "twice"}},
      {"seeds = [3, 5]", "seeds = [@'x']", {"integer"}},
      {"seeds = [3, 5]", "sedes = @[3]", {"sedes", "seeds"}},
      {"name = \"both\"", "name = @7", {"name", "text"}},
      {"name = \"both\"", "name = @'a/b'", {"slashes"}},
      {"values = [1, 6]", "values = @[]", {"values", "list"}},
      {"values = [1, 6]", "values = @3", {"values", "list"}},
      {"key = \"fleet.0.count\"", "key = @1", {"key", "text"}},
      {"set = { \"fleet.0.routes\" = [\"east_to_north\"] }",
       "set = @5",
       {"set", "table"}},
      {"seeds = [3, 5]", "seeds = [3, 5@", {}},
  };
  for (const auto& wrong : mistakes) {
    auto spoilt = changed(wrong.right, wrong.wrong);
    const auto place = take_mark(spoilt);
    CAPTURE(spoilt);
    const auto error = error_of(spoilt);
    if (wrong.says.empty()) // the place of the parser's own
      CHECK(error.starts_with("some/where.toml:"));
    else
      check_says(error, "some/where.toml" + place, wrong.says);
  }
}

TEST_CASE("a sweep without a scenario, or of too many runs, is refused") {
  CHECK(error_of("name = 'a'").find("scenario is missing")
        != std::string::npos);
  CHECK(error_of(changed("[3, 5]", "100000")).find("are the most")
        != std::string::npos);
}

TEST_CASE("two columns of one name, or a value twice, are refused") {
  CHECK(error_of(changed("\"way\"", "\"vehicles\"")).find("two columns")
        != std::string::npos);
  CHECK(error_of(changed("\"way\"", "\"seed\"")).find("two columns")
        != std::string::npos);
  CHECK(error_of(changed("[1, 6]", "[1, 1]")).find("twice")
        != std::string::npos);
}

TEST_CASE("an option is given in one place, whatever it is called there") {
  constexpr auto base = R"([[fleet]]
[[service]]
name = "trajectory_planning"
[network]
profile = "ideal"
)";
  const auto refused = [&](const std::string& from,
                           const std::vector<std::string>& overrides = {}) {
    const auto plan = parsed(from, overrides);
    try {
      check_given_once(plan, points_of(plan).front(), base);
    } catch (const input_error& problem) {
      return std::string{problem.what()};
    }
    return std::string{};
  };
  CHECK(refused(text).empty());
  CHECK(refused(text, {"duration=5s"}).empty()); // once more for all
  const auto error = refused(text, {"fleet.0.count=3"});
  CHECK(error.starts_with("fleet.0.count=3 and fleet.0.count=1 give the same"));
  CHECK_FALSE(refused(text, {"seed=9"}).empty());
  const auto with = [](std::string_view more) {
    return text + std::string{more};
  };
  CHECK_FALSE(refused(with("[[axis]]\nname = 'x'\nkey = 'fleet.0.count'\n"
                           "values = [3, 4]\n"))
                  .empty());
  CHECK_FALSE(refused(with("[[axis]]\nkey = 'service.0.period'\n"
                           "values = ['5ms']\n"))
                  .empty()); // which [set] gives by the service's name
  CHECK_FALSE(refused(with("[[axis]]\nkey = 'fleet'\nvalues = [3]\n")).empty());
}

TEST_CASE("the values of an axis may be tables") {
  const auto plan = parsed(text + R"(
[[axis]]
key = "policies.codm"
values = ["never", { name = "edf", test = "demand" }]
)");
  CHECK(plan.axes.back().values.back().given
        == std::vector<std::string>{
            R"(policies.codm={ name = "edf", test = "demand" })"});
}

TEST_CASE("an axis has either values of one option or values by name") {
  CHECK(error_of(changed("name = \"way\"", "name = \"way\"\nkey = \"seed\""))
            .find("there is no option \"key\"")
        != std::string::npos);
}
