// Programs that decide, and that do not do what they have to.
#include "programs/policy_program.hpp"

#include "base/input_error.hpp"
#include "tests/programs/asked_program.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <thread>

using namespace sofof;
using namespace sofof::programs;
using namespace sofof::test;
using namespace std::chrono_literals;

namespace sofof::running_policy_programs {

namespace fs = std::filesystem;

constexpr auto greets = R"(read hello
echo '{"sofof":1,"name":"mine","version":"2","tells":true}'
)";

std::ptrdiff_t open_files() {
  return std::distance(fs::directory_iterator{"/proc/self/fd"}, {});
}

/// A shell script as the program of a vehicle's policy.
struct scripted : asked_vehicle {
  scratch at;
  duration time_limit = 5s;
  std::vector<std::string> failures;

  std::unique_ptr<policy_program> start(const std::string& script,
                                        bool is_greeted = true) {
    write_text(at / "policy.sh", (is_greeted ? greets : "") + script);
    auto made = std::make_unique<policy_program>(
        program_setup{.side = "lodm",
                      .command = "/bin/sh policy.sh",
                      .folder = at.path(),
                      .time_limit = time_limit,
                      .scenario = "town",
                      .seed = 1});
    made->on_failure(
        [this](const std::string& why) { failures.push_back(why); });
    return made;
  }

  /// @returns what is said of a program that fails at the first ask or later.
  std::string failure_of(const std::string& script, int asks = 1) {
    const auto program = start(script);
    for (int k = 0; k < asks; ++k)
      program->decide(seen);
    CHECK_FALSE(program->decide(seen));
    REQUIRE(failures.size() == 1);
    CHECK(program->failure() == failures.front());
    return failures.front();
  }

  std::string start_failure(const std::string& script) {
    try {
      start(script, false);
    } catch (const program_error& problem) {
      return problem.what();
    }
    return {};
  }
};

TEST_CASE_FIXTURE(scripted, "a program is greeted, asked, told and taken leave "
                            "of, in this order") {
  const auto files = open_files();
  {
    const auto program = start(R"(while read line; do
  echo "$line" >>seen
  case $line in *'"ask"'*) n=$((n + 1))
    echo "{\"n\":$n,\"do\":\"run_at\",\"provider\":65538,\"why\":\"said\"}";;
  esac
done
echo over >>seen
)");
    CHECK(program->hello().name == "mine");
    for (int k = 0; k < 3; ++k) {
      const auto decided = program->decide(seen);
      REQUIRE(decided);
      CHECK(std::get<policies::run_at>(decided->what).provider == 65538);
      CHECK(decided->why.text() == "said");
      program->tell(
          policies::episode_outcome{"any", 65538, 1, "left_area", 101});
    }
    program->end();
    CHECK_FALSE(program->decide(seen));
  }
  CHECK(open_files() == files);
  const auto lines = read_file(at / "seen");
  std::size_t last = 0;
  for (const auto* word : {"\"ask\",\"n\":1", "told", "\"ask\",\"n\":2", "told",
                           "\"ask\",\"n\":3", "told", "bye", "over"}) {
    CAPTURE(word);
    last = lines.find(word, last);
    REQUIRE(last != lines.npos);
  }
  CHECK(failures.empty());
}

TEST_CASE_FIXTURE(scripted, "who has said that it is no program, or does not "
                            "greet back, is not begun with") {
  CHECK(contains(start_failure("read hello; echo '{\"sofof\":2}'"),
                 "answered hello wrongly: \"sofof\" must be 1"));
  CHECK(contains(start_failure("exit 3"), "exited with 3"));
  CHECK(contains(start_failure("exec <&- >&-; sleep 9"), "closed its output"));
  time_limit = 50ms;
  CHECK(contains(start_failure("sleep 9"), "did not answer in time"));
  CHECK_THROWS_AS(policy_program({.side = "lodm",
                                  .command = "./no_such",
                                  .folder = at.path(),
                                  .time_limit = 1s,
                                  .scenario = {}}),
                  input_error);
}

TEST_CASE_FIXTURE(scripted, "one that ends or is killed is said to have done "
                            "so, and all descriptors are closed") {
  const auto files = open_files();
  CHECK(contains(failure_of("read ask; exit 3"), "exited with 3"));
  failures.clear();
  const auto killed = failure_of("read ask; kill -9 $$");
  CHECK(contains(killed, "was ended by signal 9"));
  CHECK(contains(killed, "policies.lodm, \"/bin/sh policy.sh\""));
  CHECK(contains(killed, R"(it had got: {"type":"ask","n":1,)"));
  CHECK(open_files() == files);
}

TEST_CASE_FIXTURE(scripted, "one that is silent is waited for until its time "
                            "is over, and then ended") {
  time_limit = 1s; // also to greet, on a busy machine
  const auto begin = std::chrono::steady_clock::now();
  CHECK(contains(failure_of("trap '' TERM; read ask; sleep 60 & wait"),
                 "did not answer in time"));
  CHECK(std::chrono::steady_clock::now() - begin < 20s);
}

TEST_CASE_FIXTURE(scripted, "one that does not read is noticed, too") {
  time_limit = 1s; // also to greet, on a busy machine
  const auto program = start("sleep 9");
  const policies::cycle_outcome outcome{.at = {}, .service = "any"};
  for (int k = 0; k < 100'000 && failures.empty(); ++k)
    program->tell(outcome);
  REQUIRE(failures.size() == 1);
  CHECK(contains(failures.front(), "did not read what it was told in time"));
}

TEST_CASE_FIXTURE(scripted, "a wrong answer is quoted, shortened and without "
                            "what a terminal would obey") {
  CHECK(contains(failure_of("read a; echo '{\"n\":1,\"do\":\"fly\"}'; read b"),
                 "answered ask 1 wrongly: \"do\" must be \"stay\", "
                 "\"come_home\" or \"run_at\": {\"n\":1,\"do\":\"fly\"}"));
  failures.clear();
  const auto odd =
      failure_of("read a; printf 'a\\033[2J\\377%01000d\\n' 1; read b");
  CHECK(contains(odd, "a?[2J?000"));
  CHECK(odd.size() < 500);
}

TEST_CASE_FIXTURE(scripted, "one that babbles is stopped") {
  CHECK(
      contains(failure_of("read a; while :; do printf aaaaaaaaaaaaaaaa; done"),
               "wrote a line of more than 65536 octets: aaa"));
  failures.clear();
  CHECK(contains(failure_of("read a; printf "
                            "'{\"n\":1,\"do\":\"stay\"}\\nx\\n'; read b"),
                 "wrote more than one line"));
}

TEST_CASE_FIXTURE(scripted, "what nobody has asked for is noticed at the next "
                            "ask") {
  const auto program = start("read a; echo '{\"n\":1,\"do\":\"stay\"}'\n"
                             "read told; echo hi; >written; read b");
  REQUIRE(program->decide(seen));
  for (int k = 0; k < 10'000 && !fs::exists(at / "written"); ++k)
    program->tell(policies::episode_outcome{"any", 65538, 1, "left_area", 101});
  for (int k = 0; k < 1000 && !fs::exists(at / "written"); ++k)
    std::this_thread::sleep_for(5ms);
  CHECK_FALSE(program->decide(seen));
  REQUIRE(failures.size() == 1);
  CHECK(contains(failures.front(), "wrote what nobody had asked for: hi"));
}

TEST_CASE_FIXTURE(scripted, "as a policy it is as another one, and clones "
                            "share it") {
  const std::shared_ptr<policy_program> program =
      start("while read a; do n=$((n + 1)); "
            "echo \"{\\\"n\\\":$n,\\\"do\\\":\\\"stay\\\"}\"; done");
  const auto lodm = local_decider(program);
  CHECK(lodm->title() == "mine 2");
  const auto clone = lodm->clone();
  CHECK(std::holds_alternative<policies::stay>(lodm->decide(seen).what));
  CHECK(clone->decide(seen).why.text() == "the program says so");
  program->end();
  CHECK(clone->decide(seen).why.text() == "the program has failed");
}

} // namespace sofof::running_policy_programs
