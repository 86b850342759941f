// Where a run may write, and which files there are its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sofof::recording {

/// Of a provider's own map: behind it follow its place, from 1, and ".toml".
inline constexpr std::string_view provider_map_prefix = "map_of_provider_";

/// Makes the folder of a run: the one asked for, or else the first free one
/// of results/<scenario>-<seed>, -2, -3, …; two runs never get the same.
/// Behind the seed stands what the run was told to change.
/// @param wanted    Made with its parents where missing. One that holds
///                  anything is refused unless `force`.
/// @param scenario  Name; what does not suit a path becomes '_'.
/// @param force     Take `wanted` as it is.
/// @param changes   "policies.lodm=never" gives ulm_lehr-1,lodm=never; what is
///                  too long for a name is cut off.
/// @param parent    Of the folders that are not asked for.
/// @throws input_error when refused; nothing is left behind then.
std::filesystem::path
make_results_folder(const std::optional<std::filesystem::path>& wanted,
                    std::string_view scenario, std::int64_t seed, bool force,
                    std::span<const std::string> changes = {},
                    const std::filesystem::path& parent = "results");

/// @returns whether `file` is, or will be, one that a run writes into
/// `folder`, however the two are spelled; they need not be there.
bool is_result(const std::filesystem::path& file,
               const std::filesystem::path& folder);

/// @returns whether two paths lead to the same place, there or not.
bool same_place(const std::filesystem::path& a, const std::filesystem::path& b);

/// Removes the files of an earlier run from a folder, and nothing else; the
/// summary goes first.
/// @throws input_error when one cannot be removed.
void remove_results(const std::filesystem::path& folder);

} // namespace sofof::recording
