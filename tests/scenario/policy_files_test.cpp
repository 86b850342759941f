// What scenarios say of programs that decide and of snapshots.
#include "scenario/policy_files.hpp"

#include "base/input_error.hpp"
#include "scenario/load.hpp"
#include "scenario/run.hpp"
#include "scenario/running_programs.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;

namespace sofof::files_of_policies {

namespace fs = std::filesystem;

constexpr auto town = R"(duration = "2s"
[street_grid]
[[fleet]]
count = 1
routes = ["block *"]
[[provider]]
position_m = [100.0, 50.0]
[network]
profile = "ideal"
[[service]]
name = "trajectory_planning"
planner = "lane_follow"
[policies]
)";

constexpr auto says_its_version = "read hello; echo '{\"sofof\":1,"
                                  "\"name\":\"mine\",\"version\":\"1\"}'; "
                                  "read bye";
constexpr auto says_no_version =
    "read hello; echo '{\"sofof\":1,\"name\":\"mine\"}'; read bye";

struct own_folder {
  scratch at;

  scenario_definition load(const std::string& policies) const {
    write_text(at / "town.toml", town + policies + '\n');
    return load_scenario(at / "town.toml");
  }
  std::string error_of(const std::string& policies) const {
    try {
      load(policies);
    } catch (const input_error& problem) {
      return problem.what();
    }
    return {};
  }
  void says(const std::string& policies,
            std::initializer_list<std::string_view> parts) const {
    CAPTURE(policies);
    const auto error = error_of(policies);
    CHECK(error.starts_with((at / "town.toml").string() + ":14:"));
    for (const auto part : parts) {
      CAPTURE(error);
      CHECK(contains(error, part));
    }
  }
};

TEST_CASE_FIXTURE(own_folder, "a program that cannot be started is refused "
                              "where the scenario names it") {
  says("lodm = \"process\"", {"14:8: command must name a program"});
  says("codm = { name = \"process\", command = \"\" }",
       {"14:38: command must name a program"});
  says("lodm = { name = \"process\", command = \"./mine.sh\" }",
       {"starts with \"./mine.sh\"", at.path().string()});
  says("lodm = { name = \"process\", command = \"no_such_program x\" }",
       {"no program in PATH"});
  says("lodm = { name = \"process\", command = \"/bin/sh 'x\" }",
       {"the quote ' is not closed"});
  says("lodm = { name = \"process\", command = \"/bin/cat\", folder = \"no\" }",
       {"folder must be a folder"});
  says("lodm = { name = \"process\", command = \"/bin/cat\", time_limit = "
       "\"0s\" }",
       {"time_limit"});
  says("codm = { name = \"process\", command = \"/bin/cat\", epoch_s = 60.0 }",
       {"epoch_s"});
  says("lodm = { name = \"process\", comand = \"/bin/cat\" }",
       {"did you mean \"command\"?"});
}

TEST_CASE_FIXTURE(own_folder, "a program of PATH counts for its runs, and is "
                              "not copied") {
  const auto s =
      load("lodm = { name = \"process\", command = \"cat town.toml\" }");
  REQUIRE(s.policies.files.size() == 2);
  CHECK(s.policies.files[0].key.starts_with("lodm cat "));
  CHECK(s.policies.files[0].copy.empty());
  CHECK(s.policies.files[1].key.starts_with("lodm town.toml "));
  CHECK(s.policies.files[1].copy == "lodm_program/town.toml");
}

TEST_CASE_FIXTURE(own_folder, "who only looks at a run needs no program") {
  const auto s = parse_scenario(
      std::string{town}
          + "lodm = { name = \"process\", command = \"./gone\", folder = "
            "\"gone\" }\n",
      at / "config.toml");
  CHECK(s.policies.lodm->program()->command == "./gone");
}

TEST_CASE_FIXTURE(own_folder, "the files of a command are those of its words "
                              "and behind a =, and copies are kept of those "
                              "inside its folder") {
  fs::create_directories(at / "mine/parts");
  write_text(at / "mine/decide.sh", says_its_version);
  fs::permissions(at / "mine/decide.sh", fs::perms::owner_exec,
                  fs::perm_options::add);
  write_text(at / "mine/parts/weights", "1 2 3");
  write_text(at / "outside", "4");
  const auto s = load("lodm = { name = \"process\", folder = \"mine\", command "
                      "= \"/bin/sh decide.sh --weights=parts/weights "
                      "--more=../outside decide.sh\" }");
  std::vector<std::string> copies;
  for (const auto& file : s.policies.files)
    copies.push_back(file.copy);
  CHECK(copies
        == std::vector<std::string>{"", "lodm_program/decide.sh",
                                    "lodm_program/parts/weights", ""});
  CHECK(s.policies.files[2].text == "1 2 3");
  CHECK(s.policies.files[1].is_executable);
  CHECK_FALSE(s.policies.files[2].is_executable);
  const auto named = configuration_of(s);
  CHECK(contains(named, "folder = \"lodm_program\""));
  CHECK(s.policies.lodm->program()->folder == "mine");
  CHECK(std::ranges::count(s.read_from, at / "mine/parts/weights") == 1);
}

TEST_CASE_FIXTURE(own_folder, "what makes a run includes each file of its "
                              "programs and the version that they tell") {
  constexpr auto policies =
      "lodm = { name = \"process\", command = \"/bin/sh mine.sh\" }";
  const auto keys = [&](const std::string& script) {
    write_text(at / "mine.sh", script);
    return keys_of_policies(load(policies));
  };
  const auto first = keys(says_its_version);
  CHECK(keys(says_its_version) == first);
  CHECK_FALSE(unrepeatable_program(load(policies)));
  CHECK(keys(std::string{says_its_version} + " # more") != first);
  const auto unknown = keys(says_no_version);
  CHECK(unknown.size() == first.size() + 1);
  CHECK(contains(unrepeatable_program(load(policies)).value_or(""),
                 "tells no version"));
  CHECK(keys_of_policies(load("lodm = \"nearest\"")).empty());
}

TEST_CASE_FIXTURE(own_folder, "a snapshot is sought from the scenario's file "
                              "on, and one that does not fit is refused there, "
                              "with its own line and what to do") {
  const auto learned = load("lodm = \"q_learning\"").policies.lodm->snapshot();
  const auto head = [](const std::string& policy) {
    return "sofof snapshot 1\npolicy " + policy
           + "\nshape 160 states, 2 actions, version 1 of what is seen\n"
             "scenario town\nseeds 1000 to 1000\nprogram 0\nlearned\n";
  };
  constexpr auto policies =
      "lodm = { name = \"q_learning\", snapshot = \"q.txt\" }";
  says(policies, {(at / "q.txt").string(), "cannot be read"});
  write_text(at / "q.txt", head("dqn") + learned);
  says(policies, {"q.txt, line 2: it is of the policy \"dqn\"",
                  "sofof train FILES --policy q_learning"});
  auto other = learned;
  other.insert(other.find("\n0 0") + 1, "1 1\n");
  other.erase(other.rfind("\n0 0"), 4);
  write_text(at / "q.txt", head("q_learning") + other);
  const auto s = load(policies);
  CHECK(s.policies.lodm->snapshot() == other);
  CHECK(s.policies.lodm->clone()->snapshot() == other);
  REQUIRE(s.policies.files.size() == 1);
  CHECK(s.policies.files[0].copy == "lodm_snapshot.txt");
  CHECK(contains(configuration_of(s), "snapshot = \"lodm_snapshot.txt\""));
  const auto keys = keys_of_policies(s);
  write_text(at / "q.txt", head("q_learning") + learned);
  CHECK(keys_of_policies(load(policies)) != keys);
}

} // namespace sofof::files_of_policies
