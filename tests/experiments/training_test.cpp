// Tests of policies that learn by driving.
#include "experiments/benchmark/training.hpp"

#include "base/input_error.hpp"
#include "policies/algorithms/learning/snapshot_file.hpp"
#include "policies/registry.hpp"
#include "tests/support/bench_town.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

using namespace sofof;
using namespace sofof::experiments;
using namespace sofof::policies;
using namespace sofof::test;

namespace {

struct school {
  scratch at;
  std::atomic<bool> interrupted = false;
  std::ostringstream console;
  bench::training_options options;

  school() {
    write_text(at / "town.toml", bench_town);
    options.scenarios = {at / "town.toml"};
    options.policy = "q_learning";
    options.set = {"duration=20s", "policies.codm=always"};
    options.out = at / "learned.txt";
  }

  bool train() { return bench::train(options, interrupted, console); }
  std::string learned() const { return read_file(options.out); }

  /// @returns the sentence by which it is refused.
  std::string refusal() {
    try {
      train();
    } catch (const input_error& e) {
      return e.what();
    }
    return {};
  }
};

} // namespace

TEST_CASE_FIXTURE(school, "what is learned is a snapshot for the same policy") {
  options.version = "0.1.0";
  options.seeds = 2;
  for (const std::string name : {"q_learning", "dqn", "ucb1", "alto"}) {
    CAPTURE(name);
    options.policy = name;
    REQUIRE(train());
    const auto lodm = make_lodm(name);
    const auto before = lodm->snapshot();
    CHECK(!restore_from(learned(), *lodm));
    CHECK(lodm->snapshot() == learned_in(learned()));
    CHECK(lodm->snapshot() != before);
    CHECK(learned().starts_with("sofof snapshot 1\npolicy " + name + '\n'));
    CHECK(contains(learned(), "\nscenario town\nset duration=20s\n"
                              "set policies.codm=always\n"
                              "seeds 1000 to 1001\nprogram 0.1.0\n"));
  }
}

TEST_CASE_FIXTURE(school, "the same drives teach the same, more teach more") {
  train();
  const auto once = learned();
  train();
  CHECK(learned() == once);
  options.seeds = 2;
  train();
  CHECK(learned() != once);
  options.seeds = 1;
  options.scenarios.push_back(options.scenarios.front());
  train();
  CHECK(learned() != once);
}

TEST_CASE_FIXTURE(school, "who does not learn by driving is refused, with a "
                          "list of those who do") {
  for (const auto* name : {"location", "oracle", "no_such"}) {
    options.policy = name;
    CHECK(contains(refusal(), std::string{"\""} + name));
    CHECK(contains(refusal(), "alto, dqn, q_learning, ucb1"));
  }
}

TEST_CASE_FIXTURE(school, "a scenario that is wrong is refused before any "
                          "lesson, a place that cannot be written too") {
  options.scenarios.push_back(at / "missing.toml");
  CHECK(contains(refusal(), "missing.toml"));
  options.scenarios.pop_back();
  options.out = at / "nowhere" / "learned.txt";
  CHECK(contains(refusal(), "--out"));
  CHECK(console.str().empty());
}

TEST_CASE_FIXTURE(school, "settings that would teach nobody are refused") {
  for (const auto* one :
       {"seed=3", "policies.lodm=location", "policies.lodm={name=\"dqn\"}"}) {
    options.set.emplace_back(one);
    CHECK(contains(refusal(), "--set"));
    options.set.pop_back();
  }
  options.set.emplace_back("policies.lodm.learning=false"); // it learns, though
  train();
  CHECK(learned_in(learned()) != make_lodm("q_learning")->snapshot());
}

TEST_CASE_FIXTURE(school, "who is interrupted writes nothing") {
  interrupted = true;
  CHECK(!train());
  CHECK(!std::filesystem::exists(options.out));
}
