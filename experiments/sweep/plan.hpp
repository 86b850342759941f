// A question to many runs: one scenario, and what is varied in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments {

/// Something that is varied; a column of the results.
struct sweep_axis {
  struct value {
    std::string label;              ///< How it is called in the results.
    std::vector<std::string> given; ///< "KEY=VALUE", as for `--set`.
  };

  std::string name;
  std::vector<value> values; ///< At least one.
};

/// An option that each seed draws for itself: it varies over the seeds, and is
/// the same in all points of one seed.
struct drawn_option {
  std::string key;
  /// "KEY=VALUE", of which one is drawn; empty: a number is.
  std::vector<std::string> choices;
  double from = 0; ///< The number is uniform from here
  double to = 0;   ///< up to here.

  /// @returns "KEY=VALUE".
  std::string given(std::int64_t seed) const;
};

/// What a sweep file says.
struct sweep_plan {
  std::string name;               ///< What results are called.
  std::filesystem::path scenario; ///< The base.
  std::vector<std::string> given; ///< In all runs, "KEY=VALUE".
  std::vector<sweep_axis> axes;
  std::vector<drawn_option> draws;
  std::vector<std::int64_t> seeds{1};
  /// How many seeds a point that needs more may have, each >= seeds.size(): one
  /// for each value of the first axis, or one for all; empty: `seeds`.
  std::vector<std::size_t> most_seeds;
  /// How many seeds each combination of values has, in the order of the points;
  /// empty: `seeds`. Those beyond `seeds` count on from the
  /// largest of them.
  std::vector<std::size_t> seeds_of;
  /// The runs of its first seed are measured by the wall's clock too, all of
  /// them on one machine.
  bool measures = false;

  /// How many combinations of values there are, at most one more than
  /// `most_sweep_points`.
  std::size_t combinations() const;

  /// @returns the entry of `most_seeds` for a combination of values.
  std::size_t most_seeds_of(std::size_t combination) const;

  /// How many points there are, likewise.
  std::size_t size() const;
};

/// One run of a sweep.
struct sweep_point {
  std::vector<std::string> labels; ///< One for each axis.
  std::int64_t seed = 1;
  std::vector<std::string> given; ///< All that changes the base, in order.

  bool operator==(const sweep_point&) const = default;
};

/// More runs than this are a mistake.
inline constexpr std::size_t most_sweep_points = 100'000;

/// Reads a sweep file; docs/sweeps.md describes it.
/// @param overrides  "KEY=VALUE", for the scenario in all runs; they come
///                   after what the file gives to all, and before its axes.
/// @throws input_error with the place of the first mistake.
sweep_plan load_sweep(const std::filesystem::path& file,
                      std::span<const std::string> overrides = {});

/// The same for text in memory.
/// @param file  Where it could stand; the scenario is sought from its folder.
sweep_plan parse_sweep(std::string_view text, const std::filesystem::path& file,
                       std::span<const std::string> overrides = {});

/// @returns all points: the first axis changes slowest, seeds fastest.
/// @param plan  Its `seeds_of` is empty or has a number for each combination.
std::vector<sweep_point> points_of(const sweep_plan& plan);

/// Refuses a point of which one option is given twice: by two axes, by an axis
/// and for all runs, or by a seed of its own. Options of the file's `set` may
/// be given again on the command line.
/// @param base  The text of the plan's scenario.
/// @throws input_error naming both.
void check_given_once(const sweep_plan& plan, const sweep_point& point,
                      std::string_view base);

/// @returns "vehicles=6, seed=1": a point for people.
std::string describe(const sweep_plan& plan, const sweep_point& point);

} // namespace sofof::experiments
