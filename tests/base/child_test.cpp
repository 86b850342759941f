// Programs as children: what comes back, how they end, what they leave.
#include "base/process/child.hpp"

#include "base/input_error.hpp"

#include <doctest/doctest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace sofof::child_test {

namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

child_setup shell(std::string script) {
  child_setup setup;
  setup.command = {"sh", "-c", std::move(script)};
  return setup;
}

/// All that comes until nothing can come any more.
std::string all_of(child& of) {
  std::string text;
  std::array<std::byte, 1000> some{};
  while (of.wait(false, child::clock::now() + 10s)) {
    const auto count = of.read_some(some);
    if (!count)
      return text;
    text.append(reinterpret_cast<const char*>(some.data()), *count);
  }
  return text + " and then nothing";
}

child_end end_of(child& of) {
  while (!of.poll_end())
    of.wait(false, child::clock::now() + 1ms);
  return *of.poll_end();
}

std::size_t open_files() {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator{"/proc/self/fd"}, {}));
}

} // namespace

TEST_CASE("a child answers over its standard input and output") {
  child echo{shell("read line; echo \"got $line\"")};
  const std::string line = "one\n";
  CHECK(echo.write_some(std::as_bytes(std::span{line})) == line.size());
  CHECK(all_of(echo) == "got one\n");
  CHECK(end_of(echo).in_words() == "exited with 0");
}

TEST_CASE("how a child ended is told in words") {
  child fails{shell("exit 3")};
  CHECK(end_of(fails).in_words() == "exited with 3");
  child dies{shell("kill -9 $$")};
  CHECK(end_of(dies).in_words() == "was ended by signal 9 (Killed)");
}

TEST_CASE("what cannot be started is said at once") {
  child_setup none;
  none.command = {"no_such_program"};
  CHECK_THROWS_WITH_AS(child{none}, "there is no program \"no_such_program\".",
                       input_error);
  auto nowhere = shell("true");
  nowhere.folder = "/no/such/folder";
  CHECK_THROWS_WITH_AS(child{nowhere},
                       "the program \"sh\" cannot be started: its folder: No "
                       "such file or directory.",
                       input_error);
  auto no_group = shell("true");
  no_group.limits.cgroup = "/no/such/group";
  CHECK_THROWS_WITH_AS(child{no_group},
                       "the program \"sh\" cannot be started: its cgroup: No "
                       "such file or directory.",
                       input_error);
}

TEST_CASE("a child that does not end when it is asked to is killed") {
  child stubborn{shell("trap '' TERM; echo ready; while :; do sleep 1; done")};
  REQUIRE(stubborn.wait(false, child::clock::now() + 10s));
  CHECK(stubborn.stop(50ms).signal == SIGKILL);
  child obedient{shell("trap 'exit 4' TERM; echo ready; while :; do :; done")};
  REQUIRE(obedient.wait(false, child::clock::now() + 10s));
  CHECK(obedient.stop(10s).code == 4);
}

TEST_CASE("a child that has left its process group is ended like any other") {
  const auto leaves = [] {
    child_setup setup;
    setup.command = {SOFOF_ODD_PROGRAM, "leaves_its_group"};
    auto made = std::make_unique<child>(setup);
    REQUIRE(made->wait(false, child::clock::now() + 10s));
    REQUIRE(getpgid(made->id()) != made->id());
    return made;
  };
  CHECK(leaves()->stop(50ms).signal == SIGKILL);
  auto killed = leaves();
  killed->kill_now();
  CHECK(killed->stop(10s).signal == SIGKILL);
  leaves().reset(); // returns
}

TEST_CASE("a child starts also where standard files are closed") {
  const descriptor kept{fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)};
  close(STDIN_FILENO);
  {
    child echo{shell("read line; echo \"got $line\"")};
    const std::string line = "one\n";
    CHECK(echo.write_some(std::as_bytes(std::span{line})) == line.size());
    CHECK(all_of(echo) == "got one\n");
  }
  if (kept)
    dup2(kept.get(), STDIN_FILENO);
}

TEST_CASE("a child that somebody else reaps has ended, too") {
  const auto before = signal(SIGCHLD, SIG_IGN);
  child gone{shell("exit 3")};
  for (int k = 0; k < 10'000 && !gone.poll_end(); ++k)
    std::this_thread::sleep_for(1ms);
  signal(SIGCHLD, before);
  CHECK(gone.poll_end());
}

TEST_CASE("a command names its program and what its words say of files") {
  const auto found = [](std::string_view command) {
    std::string names;
    for (const auto& file : command_files(command_words(command), "/etc"))
      names += file.name + (file.is_sought ? " in PATH, " : ", ");
    return names;
  };
  CHECK(found("sh passwd --weights=group --other=none group")
        == "sh in PATH, passwd, group, ");
  CHECK(found("/bin/sh -c x") == "/bin/sh, ");
  CHECK(found("no_such_program .") == "");
  CHECK(found("") == "");
}

TEST_CASE("a child has no more than we may have ourselves") {
  const auto starter = fork();
  REQUIRE(starter >= 0);
  if (starter == 0) { // what it lowers stays low
    const rlimit both{500, 500};
    auto much = shell("ulimit -t");
    much.limits.cpu_s = 1000;
    child one{much};
    const auto before = all_of(one);
    setrlimit(RLIMIT_CPU, &both);
    child other{much};
    _exit(before == "1000\n" && all_of(other) == "500\n" ? 0 : 1);
  }
  int status = -1;
  CHECK(waitpid(starter, &status, 0) == starter);
  CHECK(status == 0);
}

TEST_CASE("a wait may be as long as time is") {
  child late{shell("sleep 0.05; echo here")};
  CHECK(late.wait(false, child::clock::time_point::max()));
}

TEST_CASE("what a child has started ends with it") {
  child leader{shell("sleep 1000 & echo $!; wait")};
  REQUIRE(leader.wait(false, child::clock::now() + 10s));
  std::array<std::byte, 100> text{};
  REQUIRE(leader.read_some(text).value_or(0) > 0);
  const auto other = std::atoi(reinterpret_cast<const char*>(text.data()));
  REQUIRE(kill(other, 0) == 0);
  leader.stop(1s);
  // It is the init process's to reap, if there is one.
  for (int k = 0; k < 1000 && kill(other, 0) == 0; ++k)
    if (std::ifstream stat{"/proc/" + std::to_string(other) + "/stat"};
        std::string{std::istreambuf_iterator<char>{stat}, {}}.find(") Z")
        != std::string::npos)
      break;
    else
      std::this_thread::sleep_for(1ms);
  std::ifstream stat{"/proc/" + std::to_string(other) + "/stat"};
  const std::string left{std::istreambuf_iterator<char>{stat}, {}};
  CHECK((left.empty() || left.find(") Z") != std::string::npos));
}

TEST_CASE("children leave no zombies and no open files") {
  const auto before = open_files();
  for (int k = 0; k < 20; ++k) {
    child brief{shell("exit 0")};
    if (k % 3 == 0)
      end_of(brief);
    if (k % 3 == 1)
      brief.stop(1s);
  }
  CHECK(open_files() == before);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
}

TEST_CASE("a child has no files of ours but its standard ones") {
  child lists{shell("for f in /proc/$$/fd/*; do echo ${f##*/}; done")};
  const auto text = all_of(lists);
  CHECK(text.starts_with("0\n1\n2\n"));
  CHECK(text.size() <= std::string{"0\n1\n2\n10\n"}.size()); // the shell's own
}

TEST_CASE("a child gets no more memory than its limit") {
  auto greedy =
      shell("exec 2> /dev/null; x=1234567890; while :; do x=$x$x; done");
  greedy.limits.memory_octets = 64u << 20;
  child eats{greedy};
  const auto end = end_of(eats);
  CHECK((end.code > 0 || end.signal > 0));
}

TEST_CASE("a child steps back behind others") {
  auto humble = shell("read x; cut -d' ' -f19 /proc/self/stat");
  humble.limits.nice = 7;
  child steps_back{humble};
  const std::string line = "go\n";
  steps_back.write_some(std::as_bytes(std::span{line}));
  CHECK(std::atoi(all_of(steps_back).c_str()) >= 7);
}

TEST_CASE("a child gets no more CPU time than its limit") {
  auto busy = shell("while :; do :; done");
  busy.limits.cpu_s = 1;
  child spins{busy};
  CHECK(end_of(spins).signal == SIGKILL);
}

TEST_CASE("who writes to a child that has ended gets an error and no signal") {
  child gone{shell("exit 0")};
  end_of(gone);
  const std::array<std::byte, 1> one{};
  CHECK(!gone.write_some(one));
  std::array<std::byte, 1> into{};
  CHECK(!gone.read_some(into));
}

TEST_CASE("a child that does not read takes what its socket holds, no more") {
  child deaf{shell("sleep 1000")};
  const std::vector<std::byte> much(1 << 20);
  std::size_t taken = 0;
  for (int k = 0; k < 100; ++k)
    taken += deaf.write_some(much).value_or(0);
  CHECK(taken < much.size());
  CHECK_FALSE(deaf.wait(false, child::clock::now() + 1ms));
}

TEST_CASE("a command is words, with quotes around blanks") {
  using words = std::vector<std::string>;
  CHECK(command_words("") == words{});
  CHECK(command_words("  a  b\tc ") == words{"a", "b", "c"});
  CHECK(command_words("a 'b c' \"d e\"") == words{"a", "b c", "d e"});
  CHECK(command_words("a\\ b 'c\\' \"\\\"\" ''")
        == words{"a b", "c\\", "\"", ""});
  CHECK_THROWS_AS(command_words("a 'b"), std::invalid_argument);
}

} // namespace sofof::child_test
