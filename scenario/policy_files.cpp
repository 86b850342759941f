// Words of a command that are files, and a snapshot.
#include "scenario/policy_files.hpp"

#include "base/files/regular_file.hpp"
#include "base/fingerprint.hpp"
#include "base/process/child.hpp"
#include "policies/algorithms/learning/snapshot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <unistd.h>
#include <utility>
#include <vector>

namespace sofof::scenario {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view snapshot_copy = "lodm_snapshot.txt";

/// @returns the folder of a results folder that holds copies of a program.
std::string copies_of(std::string_view side) {
  return fmt::format("{}_program", side);
}

/// @returns whether a path leads to a place in the folder that it is sought
/// from.
bool stays_inside(const fs::path& path) {
  return path.is_relative() && *path.begin() != "..";
}

/// Reads the files that the command of one side names.
class command_reader {
public:
  command_reader(scenario_definition& all, std::string_view side,
                 const toml_file& source, bool is_run)
      : all_{all}, side_{side}, source_{source}, is_run_{is_run} {}

  void read(const std::string& command, const fs::path& folder,
            const std::string& given_folder) {
    if (command.empty())
      refuse("command", "must name a program and its arguments: command = "
                        "\"/usr/bin/python3 mine.py\".");
    if (is_run_ && !fs::is_directory(folder))
      refuse("folder", fmt::format("must be a folder; \"{}\", which is {}, is "
                                   "none.",
                                   given_folder, folder.string()));
    const auto words = words_of(command);
    if (is_run_ && (words.empty() || !find_program(words.front(), folder)))
      refuse("command",
             fmt::format("starts with \"{}\", which is no program{}.",
                         words.empty() ? "" : words.front(),
                         command.find('/') == command.npos
                             ? " in PATH"
                             : " that may be executed, seen from "
                                   + folder.string()));
    for (const auto& file : command_files(words, folder))
      add(file);
  }

private:
  std::vector<std::string> words_of(const std::string& command) const {
    try {
      return command_words(command);
    } catch (const std::invalid_argument& problem) {
      refuse("command", fmt::format("cannot be read: {}.", problem.what()));
    }
  }

  void add(const command_file& named) {
    const auto& file = named.at;
    auto content = read_regular_file(file, longest_named);
    if (!content.refusal.empty())
      refuse("command", fmt::format("names the file {}, which cannot be read: "
                                    "{}.",
                                    file.string(), content.refusal));
    all_.read_from.push_back(file);
    policy_file found{.key = fmt::format("{} {}", side_,
                                         content_key(named.name, content.text)),
                      .copy = {},
                      .text = {}};
    if (const auto path = fs::path{named.name}.lexically_normal();
        !named.is_sought && stays_inside(path)) {
      found.copy = (copies_of(side_) / path).string();
      found.text = std::move(content.text);
      found.is_executable = access(file.c_str(), X_OK) == 0;
    }
    all_.policies.files.push_back(std::move(found));
  }

  [[noreturn]] void refuse(std::string_view option,
                           const std::string& why) const {
    source_.refuse(fmt::format("policies.{}.{}", side_, option),
                   fmt::format("{} {}", option, why));
  }

  scenario_definition& all_;
  std::string_view side_;
  const toml_file& source_;
  bool is_run_;
};

void load_snapshot(scenario_definition& all, const fs::path& folder,
                   const toml_file& source) {
  auto& lodm = *all.policies.lodm;
  const auto* use = lodm.learned_from();
  if (!use || use->file.empty())
    return;
  constexpr std::string_view key = "policies.lodm.snapshot";
  const auto file = folder / use->file;
  auto content = read_regular_file(file, longest_input);
  if (!content.refusal.empty())
    source.refuse(key, fmt::format("the file {} cannot be read: {}.",
                                   file.string(), content.refusal));
  if (const auto why = policies::restore_from(content.text, lodm))
    source.refuse(key,
                  fmt::format("{}, {}; train one for this policy: sofof train "
                              "FILES --policy {} --out FILE.",
                              file.string(), *why, lodm.name()));
  all.read_from.push_back(file);
  all.policies.files.push_back(
      {.key = fmt::format("lodm {}", content_key("snapshot", content.text)),
       .copy = std::string{snapshot_copy},
       .text = std::move(content.text)});
}

} // namespace

std::string content_key(std::string_view name, std::string_view text) {
  return fmt::format("{} {} {:016x}", name, text.size(), fingerprint(text));
}

void load_policy_files(scenario_definition& all, const fs::path& folder,
                       const toml_file& source, bool is_run) {
  for_each_program(all.policies, [&](std::string_view side, auto& program) {
    program.origin = folder.string();
    command_reader{all, side, source, is_run}.read(
        program.command, place_of(program), program.folder);
  });
  load_snapshot(all, folder, source);
}

void name_copies(policy_options& policies) {
  const auto has_copies = [&](const std::string& start) {
    return std::ranges::any_of(policies.files, [&](const policy_file& x) {
      return x.copy.starts_with(start);
    });
  };
  const auto rename = [&](std::string_view side, auto& policy) {
    const auto copies = copies_of(side);
    if (policy->program() && has_copies(copies + '/')) {
      policy = policy->clone();
      policy->program()->folder = copies;
    }
    if (policy->learned_from() && !policy->learned_from()->file.empty()) {
      policy = policy->clone();
      policy->learned_from()->file = snapshot_copy;
    }
  };
  rename("lodm", policies.lodm);
  rename("codm", policies.codm);
}

} // namespace sofof::scenario
