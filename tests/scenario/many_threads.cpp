// Whole runs whose plans several threads compute, in any order: the same bytes.
// tests/acceptance/scale has all scenarios, more threads and more seeds.
#include "scenario/load.hpp"
#include "scenario/run.hpp"
#include "scenario/runtime.hpp"
#include "tests/support/dice.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace sofof;
using namespace sofof::scenario;
using namespace sofof::test;

namespace {

using namespace std::chrono_literals;

/// Jobs are computed now, later, or not before somebody waits for them, by one
/// of three threads, in an order that is drawn.
class moody_pool final : public job_pool {
public:
  explicit moody_pool(std::uint64_t seed) : job_pool{0}, random_{seed} {
    for (auto k = 0; k < 3; ++k)
      threads_.emplace_back([this] { work(); });
  }
  ~moody_pool() override {
    ends_ = true;
    for (auto& x : threads_)
      x.join();
  }

  bool has_helpers() const override { return true; }
  void begin(job_ptr what) override {
    const std::lock_guard lock{mutex_};
    const auto mood = random_.between(0, 1);
    if (mood < 0.2)
      what->run();
    else if (mood < 0.8)
      waiting_.push_back(std::move(what));
  }

private:
  void work() {
    while (!ends_) {
      job_ptr next;
      {
        const std::lock_guard lock{mutex_};
        if (!waiting_.empty()) {
          const auto k = static_cast<std::size_t>(
              random_.between(0, static_cast<double>(waiting_.size())));
          std::swap(waiting_[std::min(k, waiting_.size() - 1)],
                    waiting_.back());
          next = std::move(waiting_.back());
          waiting_.pop_back();
        }
      }
      if (next)
        next->run();
      else
        std::this_thread::yield();
    }
  }

  std::mutex mutex_;
  dice random_;
  std::vector<job_ptr> waiting_;
  std::atomic<bool> ends_ = false;
  std::vector<std::thread> threads_;
};

/// @returns the lines of a summary that the wall's clock has no part in.
std::string steady_part(const std::string& summary) {
  std::istringstream lines{summary};
  std::string all;
  for (std::string line; std::getline(lines, line);)
    if (line.find("wall_s") == line.npos
        && line.find("x_real_time") == line.npos)
      all += line + '\n';
  return all;
}

/// @returns the files of a run's results, but for what the wall's clock says.
std::map<std::string, std::string> results(const scenario_definition& s,
                                           std::shared_ptr<job_pool> pool) {
  const scratch place;
  run_options how;
  how.out = place / "results";
  how.pcap = place / "plans.pcap"; // all of them, as they were sent
  how.time_decisions = false;
  const std::atomic<bool> interrupted = false;
  std::ostringstream nowhere;
  const auto time = make_virtual_runtime(std::move(pool));
  run_part(s, how, {}, *time, interrupted, nowhere);
  std::map<std::string, std::string> all{{"plans", read_file(how.pcap)}};
  for (const auto& x : std::filesystem::directory_iterator{*how.out})
    if (const auto name = x.path().filename(); name == "summary.json")
      all[name] = steady_part(read_file(x.path()));
    else if (name != "timing.csv")
      all[name] = read_file(x.path());
  return all;
}

} // namespace

TEST_CASE(
    "results are the same bytes on any number of threads, and in whatever "
    "order these compute") {
  struct drive {
    std::string file;
    std::vector<std::string> overrides;
  };
  const std::vector<drive> drives{
      {"ulm_lehr", {"duration=20s", "service.0.warm_standby=2s"}},
      // So many that plans differ if their servers look around too late.
      {"cycle", {"duration=4s", "fleet.0.count=200", "compute.workers=4"}},
      {"cycle",
       {"duration=3s", "fleet.0.count=10", "record.cycles=true",
        "service.0.planner=\"al_ilqr\""}},
      {"chain/light", {"duration=10s"}},
      {"chain/light",
       {"duration=10s", "fleet.0.compute.scheduling=\"fixed_priority\""}},
      {"crossings/t_junction", {"duration=8s"}},
  };
  for (const auto& x : drives) {
    CAPTURE(x.file);
    const auto s = load_scenario(SOFOF_SOURCE_DIR "/config/" + x.file + ".toml",
                                 x.overrides);
    const auto alone = results(s, nullptr);
    REQUIRE(alone.size() > 3);
    const auto compare = [&](std::shared_ptr<job_pool> pool) {
      const auto other = results(s, std::move(pool));
      REQUIRE(other.size() == alone.size());
      for (const auto& [name, text] : other) {
        CAPTURE(name);
        CHECK((text == alone.at(name)));
      }
    };
    compare(std::make_shared<job_pool>(3));
    compare(std::make_shared<moody_pool>(1));
  }
}
