// The files that policies name: programs that decide, and what learners have
// learned.
#pragma once

#include "base/options/toml_file.hpp"
#include "scenario/scenario.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace sofof::scenario {

/// Programs and what they go by may be longer than what is written by hand.
inline constexpr std::size_t longest_named = std::size_t{256} << 20;

/// @returns what tells a file with this content from others.
std::string content_key(std::string_view name, std::string_view text);

/// Reads them, and has learners take up what they say.
/// @param all     Gets their texts, and where programs run.
/// @param folder  Of the scenario's file.
/// @param source  Refuses what is wrong, at its place.
/// @param is_run  Else programs need not be there: results tell of a run that
///                was made elsewhere.
void load_policy_files(scenario_definition& all,
                       const std::filesystem::path& folder,
                       const toml_file& source, bool is_run);

/// Has the policies name the copies that a results folder holds.
/// @param policies  Become copies.
void name_copies(policy_options& policies);

/// @returns where a program runs, of a loaded scenario.
std::filesystem::path place_of(const auto& program) {
  namespace fs = std::filesystem;
  const auto here = fs::path{"."} / program.origin / program.folder;
  return fs::absolute(here).lexically_normal();
}

/// Calls `use(side, program_use&)` for the policy of each side that has a
/// program.
void for_each_program(const policy_options& policies, auto use) {
  if (auto* program = policies.lodm->program())
    use("lodm", *program);
  if (auto* program = policies.codm->program())
    use("codm", *program);
}

} // namespace sofof::scenario
