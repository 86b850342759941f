// All options that a file can have, as a tree: what schemas, completion and
// documents of them are made of.
#pragma once

#include "base/options/option_visitor.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

struct option_table;

enum class option_kind {
  flag,
  number,
  whole_number,
  text,
  time,  ///< A duration.
  texts, ///< A list of them.
  point, ///< [x, y]
  points,
  table,
  tables, ///< A list of them.
};

/// One option.
struct described_option {
  std::string key;
  option_kind kind = option_kind::flag;
  option_visitor::range range{};  ///< Of a number.
  duration least{};               ///< Of a duration.
  std::vector<std::string> words; ///< The only ones for a text; none: any.
  std::string instead;            ///< A word in place of a value; may be empty.
  std::string standard;           ///< Its default as TOML has it; empty: none.
  std::string now; ///< Where it has moved to, if this is a former place.
  std::shared_ptr<option_table> table; ///< What is in it, of tables; not null.
};

/// The options of a table. What there is may hang on its `name`.
struct option_table {
  struct variant {
    std::vector<std::string> names; ///< Each of which has these; none: any.
    std::string only_with;          ///< A key that must be there; often none.
    std::vector<described_option> options;
  };
  std::vector<variant> variants; ///< At least one.

  /// @returns the option in the first variant that has it; null for none.
  const described_option* find(std::string_view key) const;
};

/// Walks a list of options again and again: with and without each option that
/// may be left out, with each word that there is for another one, so that every
/// option is seen whose presence hangs on these.
/// @param list  Lists the options of an object that nobody else uses: they are
///              changed. Its defaults are those of the options.
option_table describe_options(const std::function<void(option_visitor&)>& list);

} // namespace sofof
