// What a scenario says of a program that serves as a function.
#pragma once

#include "base/options/option_visitor.hpp"
#include "base/process/kept_program.hpp"
#include "base/time.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sofof::actors {

/// A program, and what it may have.
struct program_options {
  std::string command;            ///< Its words: base/process/child.hpp.
  std::int64_t memory_mib = 2048; ///< Of address space, each; 0: no limit.
  std::int64_t cpu_s = 0;         ///< In the life of each; 0: no limit.
  std::int64_t nice = 5; ///< It steps back behind SOFOF itself by this.
  std::string cgroup;    ///< Folder of a control group; empty: none.
  duration start_limit = std::chrono::seconds{10};
  duration answer_limit = std::chrono::seconds{1};
  duration restart_pause = std::chrono::milliseconds{500};
  std::int64_t spares = 1;      ///< Started ahead at a provider.
  std::filesystem::path folder; ///< Where it stands; no option.

  void visit_options(option_visitor& s);

  /// Finds the program and all files that its command names.
  /// @param beside  The folder of the scenario: it stands there.
  /// @throws std::invalid_argument if there is no such program.
  void locate(const std::filesystem::path& beside);

  /// @returns the files that make what it computes, as `command_files` finds
  /// them. Precondition: it was located.
  std::vector<std::filesystem::path> files() const;

  /// @param configuration  Lines KEY=VALUE.
  /// @param is_virtual     Whether the time of the run is: then a program is
  ///                       waited for, and longer, so that a busy computer
  ///                       decides nothing.
  kept_setup setup(std::string configuration, std::size_t most_octets,
                   bool is_virtual) const;
};

/// What a provider runs in place of the program that a service names.
struct program_at_provider {
  std::string service;
  program_options what;

  void visit_options(option_visitor& s) {
    s.field("service", service);
    what.visit_options(s);
  }
};

} // namespace sofof::actors
