// Which file is meant by a scenario's name.
#pragma once

#include <string>

namespace sofof::apps {

/// A file that is there is itself. Else "ulm_lehr", with ".toml" or without, is
/// looked for in config/ and config/bench/, here or in the share folder of an
/// installed program, and stderr is told what was found.
/// @returns the file; the name itself where nothing is like it, so that its
/// reader says what is wrong.
/// @throws input_error with the name that is nearest to a misspelt one.
std::string find_scenario(const std::string& name);

/// @throws input_error if a file is a map, which lacks all that drives on it.
void refuse_map(const std::string& file);

} // namespace sofof::apps
