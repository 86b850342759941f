// What is wrong with a command line, in a sentence.
#pragma once

#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <string_view>

namespace sofof::apps {

/// @param app    That could not parse its words.
/// @param words  As they were given, without the program's name.
/// @returns which word is wrong, and what was perhaps meant.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error,
                        std::span<const std::string> words);

} // namespace sofof::apps
