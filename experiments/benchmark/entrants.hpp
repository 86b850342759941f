// Who is compared: an LODM and a CODM with their options, under a name.
#pragma once

#include "experiments/sweep/plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::bench {

struct entrant {
  std::string name;
  std::string lodm; ///< As for `--set`: a name, or a table with options.
  std::string codm;

  /// @returns the value of a sweep's axis that it is.
  sweep_axis::value as_value() const;
};

/// @returns an entrant for each policy that there is, but "process", with its
/// default options, beside "location" on the other side, "oracle" beside
/// "assignment": first LODMs, then CODMs. One is called after its policy; a
/// CODM whose name an LODM has too, "codm:NAME".
std::vector<entrant> plain_entrants();

/// Reads more of them, a line each: NAME = { lodm = POLICY, codm = POLICY },
/// with a policy as scenarios have it; "location" for what is left out. Files
/// that they name are sought from the folder of this file on.
/// @throws input_error with the place of the first mistake.
std::vector<entrant> load_entrants(const std::filesystem::path& file);

/// The same for text in memory.
std::vector<entrant> parse_entrants(std::string_view text,
                                    const std::string& file);

/// @returns what a scenario itself says of policies, called as its file;
/// nothing if that is "location" with its defaults on both sides, if there is
/// no such file, or if nobody could ask for that name ("all", or with a comma).
/// @throws input_error with the place of the first mistake.
std::optional<entrant> own_entrant(const std::filesystem::path& scenario);

/// Adds those of all scenarios.
/// @throws input_error also where a name is taken.
void add_own_entrants(std::vector<entrant>& to,
                      const std::vector<std::string>& scenarios);

/// @param wanted  Names separated by commas, or "all" alone. A policy may have
///                its side before it: "lodm:nearest", "codm:edf".
/// @returns those, in the order in which they are wanted.
/// @throws input_error for a name that nobody has, that stands there twice, and
/// for "all" among others.
std::vector<entrant> chosen_from(const std::vector<entrant>& all,
                                 std::string_view wanted);

} // namespace sofof::experiments::bench
