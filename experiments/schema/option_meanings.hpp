// What docs/scenarios.md and the notes of policies say of options.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::schema {

/// All of docs/scenarios.md.
extern const std::string_view scenarios_page;
extern const std::string_view programs_page;

/// The tables of a page in Markdown whose rows begin with names of options.
class documented_options {
public:
  /// @param page  Sections are those whose heading, or whose first words, have
  ///              a table's header: "`[fleet.compute]`: …", "`[[lane]]`, …".
  explicit documented_options(std::string_view page);

  /// @param path   As `meaning_of` has it.
  /// @param names  Likewise.
  /// @returns what the last column says; empty for nothing.
  std::string of(std::span<const std::string> path,
                 std::span<const std::string> names) const;

private:
  struct row {
    std::string section;              ///< "fleet.compute"; empty: the top.
    std::vector<std::string> context; ///< Words in the paragraph before.
    std::vector<std::string> keys;    ///< Words of its first column.
    std::string meaning;
  };

  std::string in_section(std::string_view section, std::string_view rest,
                         std::span<const std::string> names) const;

  std::vector<row> rows_;
  std::map<std::string, std::string> titles_; ///< Of sections.
};

/// What an option of a scenario means.
std::string scenario_meaning(std::span<const std::string> path,
                             std::span<const std::string> names);

/// What an option of a map means.
std::string map_meaning(std::span<const std::string> path,
                        std::span<const std::string> names);

} // namespace sofof::experiments::schema
