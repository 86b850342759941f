// Commands are words; what they mean is looked up beside the scenario.
#include "actors/services/programs/program_options.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace sofof::actors {

namespace fs = std::filesystem;

namespace {

/// In virtual time a program may take so many times its limit.
constexpr int patience_in_virtual_time = 10;

std::chrono::milliseconds whole_ms(duration x) {
  return std::chrono::ceil<std::chrono::milliseconds>(x);
}

} // namespace

void program_options::visit_options(option_visitor& s) {
  using namespace std::chrono_literals;
  constexpr double most = 1 << 30;
  s.field("command", command);
  try {
    command_words(command);
  } catch (const std::invalid_argument& problem) {
    s.refuse("command", fmt::format("cannot be read: {}.", problem.what()));
  }
  s.field("memory_mib", memory_mib, {0, most});
  s.field("cpu_s", cpu_s, {0, most});
  s.field("nice", nice, {0, 19});
  if (s.has("cgroup", !cgroup.empty()))
    s.field("cgroup", cgroup);
  const auto limit = [&](std::string_view key, duration& value) {
    s.field(key, value, 1ms);
    if (value > 1h) // beyond, sums of times have no room
      s.refuse(key, "must not be more than \"1h\".");
  };
  limit("start_limit", start_limit);
  limit("answer_limit", answer_limit);
  limit("restart_pause", restart_pause);
  s.field("spares", spares, {0, 64});
}

void program_options::locate(const fs::path& beside) {
  folder = beside;
  const auto words = command_words(command);
  if (words.empty())
    throw std::invalid_argument{"`command` must name a program"};
  const auto& name = words.front();
  if (!find_program(name, folder))
    throw std::invalid_argument{
        name.find('/') == name.npos
            ? fmt::format("there is no program \"{}\" in PATH", name)
            : fmt::format("there is no program {}", (folder / name).string())};
}

std::vector<fs::path> program_options::files() const {
  std::vector<fs::path> all;
  for (const auto& file : command_files(command_words(command), folder))
    all.push_back(file.at);
  return all;
}

kept_setup program_options::setup(std::string configuration,
                                  std::size_t most_octets,
                                  bool is_virtual) const {
  constexpr std::uint64_t mib = 1 << 20;
  const auto patience = is_virtual ? patience_in_virtual_time : 1;
  return {.how = {.command = command_words(command),
                  .folder = folder,
                  .environment = {},
                  .limits = {static_cast<std::uint64_t>(memory_mib) * mib,
                             static_cast<std::uint64_t>(cpu_s),
                             static_cast<int>(nice), cgroup},
                  .ends_with_thread = true},
          .configuration = std::move(configuration),
          .most_octets = most_octets,
          .start_limit = whole_ms(patience * start_limit),
          .answer_limit = whole_ms(patience * answer_limit),
          .first_pause = restart_pause,
          .waits_for_start = is_virtual};
}

} // namespace sofof::actors
