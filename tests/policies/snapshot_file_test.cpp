// Files with what learners have learned: used again, or refused.
#include "policies/algorithms/learning/snapshot_file.hpp"

#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/roadside.hpp"
#include "tests/support/toy_drive.hpp"

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <string>

using namespace sofof;
using namespace sofof::policies;
using namespace sofof::test;

namespace sofof::snapshot_files {

constexpr std::array<std::string_view, 4> learners{"q_learning", "dqn", "ucb1",
                                                   "alto"};

/// @returns one that has driven, all whose clones have learned together.
std::unique_ptr<local_policy> taught(std::string_view name, int drives = 20) {
  auto pupil = make_lodm_with(name, {.flags = {{"learning", true}}});
  const auto car = pupil->clone();
  const auto other_car = pupil->clone();
  mean_cost(*car, 1000, drives);
  mean_cost(*other_car, 2000, drives);
  return pupil;
}

std::string file_of(local_policy& pupil) {
  return snapshot_file({.policy = std::string{pupil.name()},
                        .shape = pupil.learned_from()->shape,
                        .scenarios = {"town", "village"},
                        .changes = {"duration=20s"},
                        .first_seed = 1000,
                        .seeds = 20,
                        .program = "0.1.0"},
                       pupil.snapshot());
}

std::string with(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  REQUIRE(at != text.npos);
  return text.replace(at, from.size(), to);
}

TEST_CASE("what each learner has learned decides from a file as it does in "
          "memory, and otherwise than before") {
  for (const auto name : learners) {
    CAPTURE(name);
    const auto pupil = taught(name);
    const auto in_memory = make_lodm(name);
    REQUIRE_FALSE(in_memory->restore(pupil->snapshot()));
    const auto from_file = make_lodm(name);
    const auto before = from_file->snapshot();
    REQUIRE_FALSE(restore_from(file_of(*pupil), *from_file));
    CHECK(from_file->snapshot() == pupil->snapshot());
    CHECK(from_file->snapshot() != before);
    for (std::uint64_t seed = 1; seed < 6; ++seed)
      CHECK(mean_cost(*from_file->clone(), seed, 4)
            == mean_cost(*in_memory->clone(), seed, 4));
    CHECK(from_file->snapshot() == pupil->snapshot()); // clones have their own
  }
}

TEST_CASE(
    "vehicles of a bandit that learns share it, of one that does not each "
    "has its own") {
  for (const auto name : {"ucb1", "alto"}) {
    CAPTURE(name);
    CHECK(taught(name, 2)->snapshot() != make_lodm(name)->snapshot());
    const auto alone = make_lodm(name);
    mean_cost(*alone->clone(), 1000, 2);
    CHECK(alone->snapshot() == make_lodm(name)->snapshot());
  }
}

TEST_CASE("a file says on what was trained, in lines for people") {
  const auto text = file_of(*taught("q_learning", 1));
  CHECK(text.starts_with("sofof snapshot 1\npolicy q_learning\n"
                         "shape 160 states, 2 actions, version 1 of what is "
                         "seen\nscenario town\nscenario village\n"
                         "set duration=20s\nseeds 1000 to 1019\n"
                         "program 0.1.0\nlearned\nsofof q_learning 1 "));
  CHECK(learned_in(text).starts_with("sofof q_learning 1 "));
  CHECK(learned_in("sofof ucb1 1") == "sofof ucb1 1");
}

TEST_CASE("a file of another policy, another shape, or that is no snapshot is "
          "refused with its line, and nothing changes") {
  for (const auto name : learners) {
    CAPTURE(name);
    const auto pupil = taught(name, 2);
    const auto text = file_of(*pupil);
    const auto lodm = make_lodm(name);
    const auto before = lodm->snapshot();
    const auto refusal = [&](const std::string& wrong) {
      const auto why = restore_from(wrong, *lodm);
      CHECK(lodm->snapshot() == before);
      return why.value_or("it is taken");
    };
    CHECK(refusal("") == "line 1: expected \"sofof snapshot 1\"");
    CHECK(refusal(pupil->snapshot()).starts_with("line 1: "));
    CHECK(refusal(with(text, "policy " + std::string{name}, "policy other"))
          == "line 2: it is of the policy \"other\", not of \""
                 + std::string{name} + "\"");
    CHECK(contains(refusal(with(text, "version 1", "version 2")),
                   "line 3: it has the shape \""));
    CHECK(
        contains(refusal(with(text, "\nlearned\n", "\n")), "expected a line"));
    CHECK(contains(refusal(text.substr(0, text.size() - 9)), "line "));
  }
  CHECK(contains(*restore_from(file_of(*taught("dqn", 1)), *make_lodm("ucb1")),
                 "of the policy \"dqn\", not of \"ucb1\""));
}

TEST_CASE("what is wrong behind the header has the line of the file") {
  const auto text = file_of(*taught("q_learning", 1));
  const auto lodm = make_lodm("q_learning");
  const auto head = text.substr(0, text.find("sofof q_learning"));
  CHECK(*restore_from(head
                          + "sofof q_learning 1 states 160 actions 2 "
                            "decisions 5\n0 0\nx 0\n",
                      *lodm)
        == "line 12, word 12: expected a number, found \"x\".");
}

TEST_CASE("mutated files are taken or refused, and do no harm") {
  dice random{3};
  for (const auto name : learners) {
    CAPTURE(name);
    const auto text = file_of(*taught(name, 1));
    const auto lodm = make_lodm(name);
    for (int k = 0; k < 300; ++k) {
      auto wrong = text;
      const auto reach = static_cast<double>(
          k % 2 ? wrong.size() : std::min<std::size_t>(wrong.size(), 200));
      const auto at = static_cast<std::size_t>(random.between(0, reach - 1));
      wrong[at] = static_cast<char>(random.between(-128, 128));
      if (const auto why = restore_from(wrong, *lodm))
        REQUIRE(!why->empty());
    }
    mean_cost(*lodm, 1, 1);
  }
}

} // namespace sofof::snapshot_files
