// The options of sweep files, for their reader and for their schema.
#pragma once

#include <string_view>

namespace sofof::experiments {

struct sweep_key {
  std::string_view name;
  std::string_view meaning;
};

inline constexpr sweep_key sweep_keys[]{
    {"name", "What the table of results is called, NAME.csv."},
    {"scenario", "The scenario's file, from this file's folder on."},
    {"seeds", "How many, from 1 on, or a list of them."},
    {"most_seeds",
     "So many seeds may be added where intervals are wide: a number, or one "
     "for each value of the first axis."},
    {"set", "What is changed in all runs: options of the scenario."},
    {"axis", "What is varied: one option, or several at once."},
    {"draw", "An option that each seed draws for itself."}};

/// Of an axis that varies one option.
inline constexpr sweep_key axis_keys[]{
    {"name", "Its column in the results; without: the key."},
    {"key", "The option, as --set names it."},
    {"values", "Its values, at least one."}};

/// Of an axis whose values change several options, and of one of its values.
inline constexpr sweep_key wide_axis_keys[]{
    {"name", "Its column in the results."},
    {"value", "Its values, at least one."}};
inline constexpr sweep_key wide_value_keys[]{
    {"name", "What it is called in the results."},
    {"set", "What it changes: options of the scenario."}};

/// Of an option that is drawn from a list, or between two numbers.
inline constexpr sweep_key drawn_value_keys[]{
    {"key", "The option, as --set names it."},
    {"values", "One of these values is drawn."}};
inline constexpr sweep_key drawn_number_keys[]{
    {"key", "The option, as --set names it."},
    {"from", "The number is uniform from here"},
    {"to", "up to here."}};

} // namespace sofof::experiments
