// A policy that learns by driving.
#include "experiments/benchmark/training.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "base/stopwatch.hpp"
#include "messages/protocol/no_records.hpp"
#include "policies/algorithms/learning/snapshot_file.hpp"
#include "policies/registry.hpp"
#include "scenario/build.hpp"
#include "scenario/load.hpp"
#include "scenario/running_programs.hpp"
#include "scenario/runtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace sofof::experiments::bench {

namespace {

constexpr duration a_moment = std::chrono::seconds{1};

/// @returns the names of those that learn.
std::vector<std::string> learners() {
  std::vector<std::string> names;
  for (const auto& notes : policies::lodm_notes())
    if (std::ranges::find(notes.parameters, "learning",
                          &policies::option_info::name)
        != notes.parameters.end())
      names.emplace_back(notes.name);
  return names;
}

/// Drives until the end, or until it is interrupted.
void drive(scenario::scenario_definition s,
           const std::atomic<bool>& interrupted) {
  const scenario::running_programs programs{s};
  std::string failure;
  programs.on_failure([&](const std::string& why) { failure = why; });
  const auto time = scenario::make_virtual_runtime();
  const auto actors = scenario::build(time->system(), s,
                                      std::make_shared<messages::no_records>(),
                                      time->clock(), true);
  const auto end = time->now() + s.length;
  while (time->now() < end && !interrupted && failure.empty())
    time->run_until(std::min(time->now() + a_moment, end));
  scenario::dismiss(actors, *time);
  programs.end();
  if (!failure.empty())
    throw std::runtime_error{failure};
}

class school_days {
public:
  school_days(const training_options& options,
              const std::atomic<bool>& interrupted, std::ostream& console)
      : options_{options}, interrupted_{interrupted}, shown_{console,
                                                             options.show} {
    const auto known = learners();
    if (std::ranges::find(known, options.policy) == known.end())
      throw input_error{fmt::format("\"{}\" is no policy that is trained; "
                                    "these are: {}.",
                                    options.policy, fmt::join(known, ", "))};
    for (const auto& one : options.set)
      if (one.starts_with("seed="))
        throw input_error{fmt::format("--set {}: seeds for training begin with "
                                      "{}; --seeds says how many there are.",
                                      one, first_training_seed)};
    output_file::check(options.out, choose);
    for (const auto& file : options.scenarios) // before any lesson
      pupil_ = lesson(file, first_training_seed).policies.lodm;
  }

  bool carry_out() {
    for (std::size_t k = 0; k < options_.seeds && !interrupted_; ++k)
      for (const auto& file : options_.scenarios) {
        tell(k, file);
        auto s =
            lesson(file, first_training_seed + static_cast<std::int64_t>(k));
        s.policies.lodm = pupil_;
        drive(std::move(s), interrupted_);
      }
    shown_.clear();
    if (interrupted_)
      return false;
    write_file(options_.out,
               policies::snapshot_file(header(), pupil_->snapshot()), choose);
    return true;
  }

private:
  static constexpr std::string_view choose = "another file with --out";

  scenario::scenario_definition lesson(const std::filesystem::path& file,
                                       std::int64_t seed) const {
    std::vector<std::string> set{
        "record.tracks=false", "record.cycles=false",
        fmt::format("policies.lodm={{name=\"{}\"}}", options_.policy)};
    std::ranges::copy(options_.set, std::back_inserter(set));
    set.push_back(fmt::format("seed={}", seed));
    set.emplace_back("policies.lodm.learning=true");
    auto s = scenario::load_scenario(file, set);
    if (s.policies.lodm->name() != options_.policy)
      throw input_error{
          fmt::format("--set policies.lodm: it is {} that learns, "
                      "by --policy.",
                      options_.policy)};
    return s;
  }

  policies::snapshot_header header() const {
    policies::snapshot_header all;
    all.policy = options_.policy;
    all.shape = pupil_->learned_from()->shape;
    for (const auto& file : options_.scenarios)
      all.scenarios.push_back(file.stem().string());
    all.changes = options_.set;
    all.first_seed = first_training_seed;
    all.seeds = options_.seeds;
    all.program = options_.version;
    return all;
  }

  void tell(std::size_t k, const std::filesystem::path& file) {
    shown_.show(
        [&] {
          return fmt::format("{} learns  seed {} of {}  {}", options_.policy,
                             k + 1, options_.seeds, file.stem().string());
        },
        watch_.elapsed_s());
  }

  const training_options& options_;
  const std::atomic<bool>& interrupted_;
  recording::progress shown_;
  stopwatch watch_;
  // Its clones share one q_function.
  std::shared_ptr<policies::local_policy> pupil_;
};

} // namespace

bool train(const training_options& options,
           const std::atomic<bool>& interrupted, std::ostream& console) {
  assert(!options.scenarios.empty() && options.seeds >= 1);
  return school_days{options, interrupted, console}.carry_out();
}

} // namespace sofof::experiments::bench
