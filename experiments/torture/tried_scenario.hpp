// What is tried: a scenario, and foul play in it.
#pragma once

#include "base/options/option_helpers.hpp"
#include "experiments/torture/lying_chain.hpp"
#include "experiments/torture/lying_planning.hpp"
#include "scenario/scenario.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sofof::experiments::torture {

/// All that a provider may lie about.
inline constexpr auto all_lie_names = [] {
  std::array<std::string_view, lie_names.size() + chain_lie_names.size()> all;
  std::ranges::copy(chain_lie_names,
                    std::ranges::copy(lie_names, all.begin()).out);
  return all;
}();

/// The table [lies].
struct lie_options {
  std::string what = "jump"; ///< What services at providers say instead.
  duration after = std::chrono::seconds{8}; ///< Of each session.

  void visit_options(option_visitor& s) {
    visit_word(s, "what", what, "lie", all_lie_names);
    s.field("after", after, duration{});
  }
};

/// The table [hostile]: a station that sends providers what no honest one
/// would.
struct hostile_options {
  duration every = std::chrono::milliseconds{100}; ///< It says something.

  void visit_options(option_visitor& s) {
    s.field("every", every, std::chrono::milliseconds{1});
  }
};

/// A scenario as text.
struct tried_scenario {
  /// Of a scenario file, which may have the tables above besides: those are
  /// none that `sofof run` knows.
  std::string text;
  /// Where it stands, or could: files that it names are sought from there on.
  std::filesystem::path file = "torture.toml";
};

/// The same, ready to run.
struct loaded_scenario {
  scenario::scenario_definition what; ///< Lies included.
  std::optional<lie_options> lies;
  std::optional<hostile_options> hostile;
};

/// @throws input_error with the place of the first mistake.
loaded_scenario load(const tried_scenario& tried);

/// Runs it in virtual time; the results are in the folder then, a new one.
/// @returns how many hostile messages were sent.
/// @throws what ends a run early.
std::uint64_t run(const loaded_scenario& s,
                  const std::filesystem::path& folder);

} // namespace sofof::experiments::torture
