// From options to a JSON schema, for editors and for whoever makes files.
#pragma once

#include "base/options/option_tree.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace sofof::experiments::schema {

/// @param path   Keys from the top of the file to an option, lists by their
///               key: {"fleet", "compute", "cores"}.
/// @param names  Of the variant of its table that has it:
/// {"trajectory_planning"}.
/// @returns what the option means; empty if nobody says.
using meaning_of = std::function<std::string(
    std::span<const std::string> path, std::span<const std::string> names)>;

/// A JSON schema, draft 7, of files that have these options. It refuses unknown
/// keys, wrong types, numbers out of their ranges and unknown words; what hangs
/// on several options is for the program to refuse.
/// @param title  What the files are: "A scenario of SOFOF".
nlohmann::ordered_json json_schema(const option_table& all,
                                   std::string_view title,
                                   const meaning_of& meaning);

/// The same of files in which any name has such a table.
nlohmann::ordered_json named_tables_schema(const option_table& each,
                                           std::string_view title,
                                           const meaning_of& meaning);

/// The same of a table `{ KEY = VALUE }` that changes options, as `[set]` of a
/// sweep has it: keys are dotted paths, or tables for parts of them.
/// @param definitions  Gets what the returned schema refers to.
nlohmann::ordered_json changes_schema(const option_table& all,
                                      nlohmann::ordered_json& definitions);

/// @returns a regular expression for the dotted path of any option.
std::string path_pattern(const option_table& all);

} // namespace sofof::experiments::schema
