// Problem files: what is read, what is said, and how well it is solved.
#include "experiments/solve/solve.hpp"

#include "base/input_error.hpp"
#include "experiments/solve/practice_file.hpp"
#include "experiments/solve/problem_file.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <unistd.h>

using namespace sofof;
using namespace sofof::experiments;
using nlohmann::json;
using test::contains;
namespace fs = std::filesystem;

namespace {

/// A file that is gone with its test.
class scratch_file {
public:
  explicit scratch_file(std::string_view name)
      : path_{fs::temp_directory_path()
              / ("sofof_solve_" + std::to_string(getpid()) + "_"
                 + std::string{name})} {}
  ~scratch_file() { fs::remove(path_); }
  scratch_file(const scratch_file&) = delete;
  scratch_file& operator=(const scratch_file&) = delete;

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

json read_problems(const fs::path& file) {
  std::ifstream in{file};
  return json::parse(in);
}

void write_problems(const fs::path& file, const json& content) {
  std::ofstream{file} << content;
}

struct outcome {
  std::vector<json> lines;
  std::string screen;

  int count(std::string_view status) const {
    return static_cast<int>(std::ranges::count_if(
        lines, [&](const auto& line) { return line["status"] == status; }));
  }
};

outcome solve(const fs::path& file, bool cold = false) {
  const scratch_file out{"out.jsonl"};
  std::ostringstream screen;
  solve_problems(file, {.cold = cold, .repeat = 1, .out = out.path()}, screen);
  outcome all{{}, screen.str()};
  std::ifstream in{out.path()};
  for (std::string line; std::getline(in, line);)
    all.lines.push_back(json::parse(line));
  return all;
}

/// What is refused, and in which words.
std::string refusal(std::string_view kind,
                    const std::function<void(json&)>& spoil) {
  const scratch_file file{"spoilt.json"};
  write_practice(file.path(), kind);
  auto content = read_problems(file.path());
  content["instances"].get_ref<json::array_t&>().resize(2);
  spoil(content);
  write_problems(file.path(), content);
  try {
    solve(file.path());
  } catch (const input_error& e) {
    return e.what();
  }
  return {};
}

/// The status of the second of two instances.
std::string status_of_second(std::string_view kind,
                             const std::function<void(json&)>& spoil) {
  const scratch_file file{"odd.json"};
  write_practice(file.path(), kind);
  auto content = read_problems(file.path());
  content["instances"].get_ref<json::array_t&>().resize(2);
  spoil(content["instances"][1]);
  write_problems(file.path(), content);
  return solve(file.path()).lines.at(1)["status"];
}

} // namespace

TEST_CASE("practice problems are solved, warm and cold") {
  for (const auto kind : {"path", "velocity"})
    for (const auto cold : {false, true}) {
      const scratch_file file{"practice.json"};
      write_practice(file.path(), kind);
      const auto all = solve(file.path(), cold);
      CAPTURE(kind);
      CHECK(all.lines.size() == 120);
      CHECK(all.count("CONVERGED") + all.count("ACCEPTABLE") == 120);
      CHECK(all.count("CONVERGED") >= 118);
      CHECK(contains(all.screen, "p50"));
    }
}

TEST_CASE("a line says all there is to know about a solve") {
  const scratch_file file{"practice.json"};
  write_practice(file.path(), "path");
  for (const auto& line : solve(file.path()).lines) {
    CHECK(line["cost"].get<double>() > 0);
    CHECK(line["violation"].get<double>() < 1e-3);
    CHECK(line["iterations"].get<int>() > 0);
    CHECK(line["time_us"].get<double>() > 0);
    CHECK(line["u"].size() == 80);
  }
}

TEST_CASE("a file solved twice gives the same plans") {
  const scratch_file file{"practice.json"};
  write_practice(file.path(), "velocity");
  const auto first = solve(file.path()), second = solve(file.path());
  for (std::size_t i = 0; i < first.lines.size(); ++i)
    CHECK(first.lines[i]["u"] == second.lines[i]["u"]);
}

TEST_CASE("a reference decides what is ok") {
  const scratch_file file{"practice.json"};
  write_practice(file.path(), "path");
  const auto costs = solve(file.path());
  auto content = read_problems(file.path());
  content["instances"].get_ref<json::array_t&>().resize(4);
  for (std::size_t i = 0; i < 4; ++i)
    content["instances"][i]["reference"] = {{"feasible", true},
                                            {"cost", costs.lines[i]["cost"]}};
  content["instances"][1]["reference"]["cost"] =
      0.9 * costs.lines[1]["cost"].get<double>();
  content["instances"][2]["reference"]["feasible"] = false;
  write_problems(file.path(), content);
  CHECK(contains(solve(file.path()).screen, "2 of 4"));
}

TEST_CASE("a problem file that cannot be used is refused with its place") {
  const auto bad = [](auto spoil) { return refusal("path", spoil); };
  CHECK(contains(bad([](json& f) { f.erase("N"); }), "\"N\" is missing"));
  CHECK(contains(bad([](json& f) { f["problem"] = "pth"; }), "\"path\""));
  CHECK(contains(bad([](json& f) { f["instances"][1].erase("hi"); }),
                 "instances[1]: the field \"hi\""));
  CHECK(contains(bad([](json& f) { f["instances"][1]["lo"] = 3; }),
                 "instances[1].lo: this should be a list"));
  CHECK(contains(bad([](json& f) { f["instances"][0]["d_ref"][7] = "x"; }),
                 "instances[0].d_ref[7]: this should be a number"));
  CHECK(contains(bad([](json& f) {
                   f["instances"][0]["x0"] = {1, 2};
                 }),
                 "3 numbers"));
  CHECK(contains(bad([](json& f) { f["instances"] = 1; }), "a list"));
  CHECK(contains(
      refusal("velocity", [](json& f) { f["instances"][0].erase("limits"); }),
      "\"limits\" is missing"));
  CHECK_THROWS_AS(load_problems("no such file"), input_error);
  CHECK_THROWS_AS(load_problems(fs::temp_directory_path()), input_error);
  const scratch_file broken{"broken.json"};
  std::ofstream{broken.path()} << "{\"problem\": ";
  CHECK_THROWS_AS(load_problems(broken.path()), input_error);
}

TEST_CASE("numbers that make no sense are the solver's to refuse") {
  const auto path = [](auto spoil) { return status_of_second("path", spoil); };
  const auto velocity = [](auto spoil) {
    return status_of_second("velocity", spoil);
  };
  CHECK(path([](json& x) { x["x0"][1] = nullptr; }) == "BAD_INPUT");
  CHECK(path([](json& x) { x["kappa_ref"].erase(5); }) == "BAD_INPUT");
  CHECK(path([](json& x) { x["lo"][9].erase(1); }) == "BAD_INPUT");
  CHECK(path([](json& x) { x["hi"][9][2] = nullptr; }) == "BAD_INPUT");
  CHECK(path([](json& x) { x["lo"][30][1] = 9; }) == "SOFT_INFEASIBLE");
  CHECK(velocity([](json& x) { x["w_ref"][3] = 0; }) == "BAD_INPUT");
  CHECK(velocity([](json& x) { x["t_lo"].erase(3); }) == "BAD_INPUT");
  CHECK(velocity([](json& x) { x["k_stop"] = -4; }) == "BAD_INPUT");
  CHECK(velocity([](json& x) { x["k_stop"] = 4; }) == "SOFT_INFEASIBLE");
}

TEST_CASE("practice of an unknown kind is refused") {
  CHECK_THROWS_AS(write_practice("never.json", "chess"), input_error);
  CHECK_THROWS_AS(write_practice("/no/such/folder/x.json", "path"),
                  input_error);
}

TEST_CASE("optima that are known without a solver are found") {
  const scratch_file file{"straight.json"};
  write_practice(file.path(), "path");
  auto content = read_problems(file.path());
  content["instances"].get_ref<json::array_t&>().resize(4);
  // Straight on and far from all bounds; the last is the second, mirrored.
  const double offsets_m[]{0, 0.01, 0.02, -0.01};
  for (std::size_t i = 0; i < 4; ++i) {
    auto& x = content["instances"][i];
    x["x0"] = {offsets_m[i], 0, 0};
    for (const auto* name : {"kappa_ref", "d_ref"})
      for (auto& value : x[name])
        value = 0;
    for (const auto& [name, bound] : {std::pair{"lo", -9}, std::pair{"hi", 9}})
      for (auto& row : x[name])
        for (auto& value : row)
          value = bound;
  }
  write_problems(file.path(), content);
  for (const auto cold : {false, true}) {
    CAPTURE(cold);
    const auto all = solve(file.path(), cold);
    CHECK(all.count("CONVERGED") == 4);
    const auto cost = [&all](std::size_t i) {
      return all.lines.at(i)["cost"].get<double>();
    };
    CHECK(cost(0) == doctest::Approx(0).epsilon(1e-9));
    CHECK(cost(1) > 0);
    CHECK(cost(3) == doctest::Approx(cost(1)).epsilon(5e-3));
    // Small offsets are a linear problem of squared costs.
    CHECK(cost(2) == doctest::Approx(4 * cost(1)).epsilon(5e-3));
  }
}

// References from Ipopt, beside the checkout: not everybody has them. The test
// before holds optima of our own.
TEST_CASE("problems with known optima are solved, warm and cold") {
  for (const auto name : {"path80.json", "vel160.json"}) {
    const auto file =
        fs::path{SOFOF_SOURCE_DIR "/../shared/data/planner"} / name;
    if (!fs::exists(file)) {
      MESSAGE("SKIPPED: no " << file.string());
      continue;
    }
    for (const auto cold : {false, true}) {
      CAPTURE(name);
      CAPTURE(cold);
      const auto all = solve(file, cold);
      CHECK(contains(all.screen, "120 of 120"));
      const auto known = read_problems(file)["instances"];
      for (std::size_t i = 0; i < known.size(); ++i) {
        const auto& reference = known[i]["reference"];
        CAPTURE(i);
        if (!reference["feasible"].get<bool>())
          continue;
        CHECK(all.lines[i]["status"] == "CONVERGED");
        // Below the reference: by the tolerance on violations.
        CHECK(
            all.lines[i]["cost"].get<double>()
            == doctest::Approx(reference["cost"].get<double>()).epsilon(5e-3));
      }
    }
  }
}
