// Loads options from a table of a TOML file.
#pragma once

#include "base/options/option_note.hpp"
#include "base/options/option_visitor.hpp"

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// So begins what the "file" of a node is called that the command line made.
inline constexpr std::string_view command_line_prefix = "--";

/// @returns where something stands: `FILE:LINE:COLUMN`, `--set KEY=VALUE` or
/// `--duration 20s`.
/// @param file  Stands in when the node does not know.
std::string place_of(const toml::source_region& region, std::string_view file);

/// Writes into options what one table says. What does not fit is thrown as
/// `input_error` with its place.
class toml_options final : public option_visitor {
public:
  /// @param node   A table, or a string that stands for a table with that
  ///               `name`; outlives this. Options at former places are moved.
  /// @param file   What the file is called; outlives this.
  /// @param notes  Gets what is to be told; outlives this.
  toml_options(toml::node& node, std::string_view file,
               std::vector<option_note>& notes);

  using option_visitor::field;
  void field(std::string_view key, bool& value) override;
  void field(std::string_view key, double& value, range r) override;
  void field(std::string_view key, std::int64_t& value, range r) override;
  void field(std::string_view key, std::string& value) override;
  void field(std::string_view key, duration& value, duration min) override;
  void field(std::string_view key, std::vector<std::string>& value) override;
  void field(std::string_view key, point& value) override;
  void field(std::string_view key, std::vector<point>& value) override;
  void table(std::string_view key,
             const std::function<void(option_visitor&)>& list) override;
  void tables(
      std::string_view key, std::size_t size,
      const std::function<void(std::size_t, option_visitor&)>& list) override;
  bool has(std::string_view key, bool set) override;
  bool word(std::string_view key, std::string_view what, bool says) override;
  bool moved(std::string_view from, std::string_view to) override;
  void note(std::string_view key, const std::string& what) override;
  void refuse(std::string_view key, const std::string& why) override;

  /// Refuses keys of the table that nobody asked for.
  void finish() const;

private:
  toml::node* find(std::string_view key);
  [[noreturn]] void fail(const toml::node& at, std::string_view key,
                         std::string_view why) const;
  void check(const toml::node& at, std::string_view key, double value,
             range r) const;
  double read_number(const toml::node& n, std::string_view key) const;
  std::string read_string(const toml::node& n, std::string_view key) const;
  point read_point(const toml::node& n, std::string_view key) const;
  const toml::array& read_list(const toml::node& n, std::string_view key,
                               std::string_view wanted) const;

  toml::node& node_;
  std::string_view file_;
  std::vector<option_note>& notes_;
  std::vector<std::string> asked_; // keys
};

} // namespace sofof
