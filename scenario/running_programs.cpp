// From options of policies to programs that run.
#include "scenario/running_programs.hpp"

#include "scenario/placement.hpp"
#include "scenario/policy_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <mutex>
#include <unistd.h>

namespace sofof::scenario {

namespace {

programs::program_setup setup_of(const scenario_definition& s,
                                 std::string_view side, const auto& use) {
  return {.side = std::string{side},
          .command = use.command,
          .folder = place_of(use),
          .time_limit = use.time_limit,
          .scenario = s.name,
          .seed = static_cast<std::uint64_t>(s.seed)};
}

/// @returns what tells apart programs that may be different.
std::string program_identity(const scenario_definition& s,
                             std::string_view side,
                             const programs::program_setup& setup) {
  auto text =
      fmt::format("{}\n{}\n{}\n", side, setup.command, setup.folder.string());
  for (const auto& file : s.policies.files)
    text += file.key + '\n';
  return text;
}

/// @returns what a program says of itself; asked once, though a sweep loads it
/// again and again.
programs::hello_answer hello_of(const scenario_definition& s,
                                std::string_view side, const auto& use) {
  static std::mutex lock;
  static std::map<std::string, programs::hello_answer> known;
  auto setup = setup_of(s, side, use);
  const auto identity = program_identity(s, side, setup);
  const std::lock_guard locked{lock};
  auto i = known.find(identity);
  if (i == known.end()) {
    const programs::policy_program greeted{std::move(setup)};
    i = known.emplace(identity, greeted.hello()).first;
  }
  return i->second;
}

/// @returns a text that no other process has had, or will have.
const std::string& this_process() {
  static const auto text = [] {
    std::string uuid;
    std::getline(std::ifstream{"/proc/sys/kernel/random/uuid"}, uuid);
    return fmt::format("{} {}", getpid(), uuid);
  }();
  return text;
}

} // namespace

deciding_sides deciding_in(const scenario_definition& s,
                           const process_share& here) {
  deciding_sides sides{false, false};
  for (const auto& v : place_vehicles(s))
    sides.lodm = sides.lodm || here.drives(v.station);
  for (std::size_t k = 0; k < s.providers.size(); ++k)
    sides.codm = sides.codm || lives_here(s, here, k);
  return sides;
}

running_programs::running_programs(scenario_definition& s,
                                   deciding_sides here) {
  const auto start = [&](std::string_view side, auto& policy, auto make) {
    const auto* use = policy->program();
    if (!use)
      return;
    all_.push_back(
        std::make_shared<programs::policy_program>(setup_of(s, side, *use)));
    policy = policy->clone();
    policy->program()->decider = make(all_.back());
  };
  if (here.lodm)
    start("lodm", s.policies.lodm, programs::local_decider);
  if (here.codm)
    start("codm", s.policies.codm, programs::central_decider);
}

running_programs::~running_programs() {
  end();
}

void running_programs::on_failure(
    const std::function<void(const std::string&)>& tell) const {
  for (const auto& program : all_)
    program->on_failure(tell);
}

bool running_programs::have_failed() const {
  return std::ranges::any_of(
      all_, [](const auto& program) { return program->failure().has_value(); });
}

void running_programs::end() const {
  for (const auto& program : all_)
    program->end();
}

std::vector<std::string> keys_of_policies(const scenario_definition& s) {
  std::vector<std::string> keys;
  for (const auto& file : s.policies.files)
    keys.push_back(file.key);
  for_each_program(s.policies, [&](std::string_view side, const auto& use) {
    const auto self = hello_of(s, side, use);
    keys.push_back(fmt::format("{} {}\n{}", side, self.name, self.version));
    if (self.version.empty())
      keys.push_back(this_process());
  });
  return keys;
}

std::optional<std::string> unrepeatable_program(const scenario_definition& s) {
  std::optional<std::string> sentence;
  for_each_program(s.policies, [&](std::string_view side, const auto& use) {
    if (!sentence && hello_of(s, side, use).version.empty())
      sentence = fmt::format(
          "the program of policies.{}, \"{}\", tells no version in its answer "
          "to hello, so its runs are made anew each time and cannot be shared "
          "out to shards; give it a version, or leave out --shard.",
          side, use.command);
  });
  return sentence;
}

} // namespace sofof::scenario
