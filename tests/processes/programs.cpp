// Programs that serve as functions, as processes beside the program.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <set>
#include <string>

namespace sofof::programs_test {

namespace {

using namespace sofof::test;
namespace fs = std::filesystem;

/// A mark that programs inherit, by which they are found.
class marked {
public:
  marked() : mark_{"SOFOF_TEST_MARK=" + std::to_string(getpid())} {
    setenv("SOFOF_TEST_MARK", std::to_string(getpid()).c_str(), 1);
  }
  ~marked() { unsetenv("SOFOF_TEST_MARK"); }
  marked(const marked&) = delete;
  marked& operator=(const marked&) = delete;

  /// @returns those programs that run.
  std::set<pid_t> programs() const {
    std::set<pid_t> found;
    std::error_code ignored;
    for (const auto& x : fs::directory_iterator{"/proc", ignored}) {
      const auto told = read_file(x.path() / "environ");
      if (contains(told, mark_) && contains(told, "SOFOF_SERVICE="))
        found.insert(std::atoi(x.path().filename().c_str()));
    }
    return found;
  }

private:
  std::string mark_;
};

std::vector<std::string> run_with(const std::string& behaviour) {
  return {"run",
          "config/object_detection.toml",
          "--realtime",
          "--quiet",
          "--out",
          "out",
          "--set",
          "duration=600s",
          "--set",
          "fleet.0.count=2",
          "--set",
          "service.object_detection.command=\"" SOFOF_ODD_PROGRAM " "
              + behaviour + "\""};
}

} // namespace

TEST_CASE("programs end with SOFOF, however that ends") {
  for (const auto signal : {SIGINT, SIGKILL}) {
    CAPTURE(signal);
    const workplace at;
    const marked by;
    program run{run_with("is_silent"), at.here()};
    REQUIRE(wait_until([&] { return by.programs().size() >= 4; }));
    run.send(signal);
    run.wait();
    CHECK(wait_until([&] { return by.programs().empty(); }));
  }
}

TEST_CASE("a run goes on when its programs are killed, and they are back") {
  const workplace at;
  const marked by;
  program run{run_with("has_none"), at.here()};
  REQUIRE(wait_until([&] { return by.programs().size() >= 4; }));
  const auto before = by.programs();
  for (const auto one : before)
    kill(one, SIGKILL);
  CHECK(wait_until([&] {
    std::size_t others = 0;
    for (const auto one : by.programs())
      others += before.count(one) == 0 ? 1 : 0;
    return others >= 4;
  }));
  CHECK(run.runs());
  run.send(SIGINT);
  CHECK(run.wait().signal == 0);
}

} // namespace sofof::programs_test
