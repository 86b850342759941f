// An option that has moved within a file, brought to its new place: what is
// behind `option_visitor::moved`, which a list of options calls.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>

namespace sofof {

/// Where an option stood.
struct former_place {
  std::string place; ///< As `place_of` has it.
  bool counts =
      false; ///< Else what stands at the new place does, for all of it.
};

/// Moves what stands at one dotted path of a table to another one; of a table,
/// each of its options. Of two that say the same option, one in a file and one
/// of `--set`, the latter counts.
/// @param file  What the file is called.
/// @returns nothing if there was none, or something else is in the way, which
/// is then refused as any wrong value.
/// @throws input_error when both places say the same option.
std::optional<former_place> move_option(toml::table& table,
                                        std::string_view from,
                                        std::string_view to,
                                        std::string_view file);

} // namespace sofof
